"""Loads a benchmark of questions by the code of the evaluators themselves: python evaluators.py FOLDER.

Needs datasets==5.2.0 and inspect-ai==0.3.285. lmms-eval==0.7.3 and lm-eval==0.4.13, which need torch, are tried where
they are installed (.ci/evaluators). A model that always answers B must have the share of questions whose answer it is.
"""

import json
import os
import sys
import tempfile
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()
os.chdir(ROOT)
os.environ["HF_DATASETS_CACHE"] = tempfile.mkdtemp()
os.environ["HF_HUB_OFFLINE"] = "1"
LINES = [json.loads(line) for line in (ROOT / "lmms_eval" / "questions.jsonl").read_text().splitlines()]
SHARES = {letter: sum(line["answer"] == letter for line in LINES) / len(LINES) for letter in "ABCDE"}


def hugging_face():
    from datasets import Video, load_dataset

    table = load_dataset("parquet", data_files=str(ROOT / "data" / "test-*.parquet"), split="train")
    assert isinstance(table.features["video"], Video), table.features
    names = table.features["answer_index"].names
    table = table.cast_column("video", Video(decode=False))
    assert len(table) == len(LINES)
    by_id = {line["question_id"]: line for line in LINES}
    for row in table:
        line = by_id[row["question_id"]]
        assert row["video"]["bytes"] == (ROOT / "videos" / line["video"]).read_bytes(), row["question_id"]
        assert (names[row["answer_index"]], row["options"]) == (line["answer"], line["options"])
        assert table.features["task"].int2str(row["task"]) == line["task"]
        assert json.loads(row["proof"])


def inspect():
    from inspect_ai import eval as run
    from inspect_ai.model import ModelOutput, ModelUsage, get_model

    sys.path.insert(0, str(ROOT / "inspect"))
    from phase_questions import CONTROLS, phase_questions

    for control in CONTROLS:
        output = ModelOutput.from_content("mockllm/model", "ANSWER: B")
        # Without a usage the mock model counts tokens, and loads a tokeniser from the network for it.
        output.usage = ModelUsage(input_tokens=1, output_tokens=1, total_tokens=2)
        outputs = (output for _ in iter(int, 1))
        model = get_model("mockllm/model", custom_outputs=outputs)
        [log] = run(phase_questions(control=control), model=model, log_dir=tempfile.mkdtemp(), display="none")
        assert log.status == "success", log.error.message
        right = [sample.scores["choice"].value == "C" for sample in log.samples]
        assert sum(right) / len(right) == SHARES["B"], (control, sum(right), len(right))
        assert len(log.samples) == len(LINES)


def lmms_eval():
    from lmms_eval.api.model import lmms
    from lmms_eval.evaluator import simple_evaluate
    from lmms_eval.tasks import TaskManager, get_task_dict

    class SaysB(lmms):
        """Looks at what it is shown, and answers B."""

        def generate_until(self, requests):
            for _, _, visual, doc, task, split in (request.args for request in requests):
                doc = self.task_dict[task][split][doc]
                assert all(Path(path).is_file() for path in visual(doc))
            return ["B" for _ in requests]

        def loglikelihood(self, requests):
            raise NotImplementedError

        def generate_until_multi_round(self, requests):
            raise NotImplementedError

    manager = TaskManager(include_path=str(ROOT / "lmms_eval"), include_defaults=False)
    names = ["phase_questions", "phase_questions_text"]
    task = get_task_dict(names, manager)["phase_questions_text"]
    docs = list(task.test_docs())
    assert docs[0]["text"] in task.doc_to_text(docs[0])
    for doc in docs:
        assert task.process_results(doc, [f"({doc['answer']})"])["accuracy"]["right"] == 1.0
    found = simple_evaluate(SaysB(), tasks=names, task_manager=manager, bootstrap_iters=0)
    for name in names:
        assert abs(found["results"][name]["accuracy,none"] - SHARES["B"]) < 1e-9, found["results"]


def lm_eval():
    from lm_eval import simple_evaluate
    from lm_eval.api.model import LM
    from lm_eval.tasks import TaskManager

    class Likes(LM):
        """Finds one option likely."""

        def __init__(self, option):
            super().__init__()
            self.option = option

        def loglikelihood(self, requests):
            return [(0.0 if request.idx == self.option(request.doc) else -9.0, False) for request in requests]

        def loglikelihood_rolling(self, requests):
            raise NotImplementedError

        def generate_until(self, requests):
            raise NotImplementedError

    manager = TaskManager(include_path=str(ROOT / "lm_eval"), include_defaults=False)
    for option, wanted in ((lambda doc: doc["answer_index"], 1.0), (lambda doc: 0, SHARES["A"])):
        found = simple_evaluate(
            model=Likes(option), tasks=["phase_questions_text"], task_manager=manager, bootstrap_iters=0)
        assert abs(found["results"]["phase_questions_text"]["acc,none"] - wanted) < 1e-9, found["results"]


for check, needed in ((hugging_face, True), (inspect, True), (lmms_eval, False), (lm_eval, False)):
    try:
        check()
        print(f"{check.__name__}: loaded, {len(LINES)} questions")
    except ImportError as error:
        if needed:
            raise
        print(f"{check.__name__}: skipped, {error}")
