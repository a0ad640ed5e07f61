"""Loads a benchmark of questions by the code of the evaluators themselves: python evaluators.py FOLDER.

Needs datasets==5.2.0 and inspect-ai==0.3.285; lmms-eval==0.7.3 and lm-eval are tried where they are installed.
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
    from lmms_eval.tasks import TaskManager, get_task_dict

    manager = TaskManager(include_path=str(ROOT / "lmms_eval"), include_defaults=False)
    tasks = get_task_dict(["phase_questions", "phase_questions_text"], manager)
    task = tasks["phase_questions"]
    docs = list(task.test_docs())
    assert len(docs) == len(LINES)
    for doc in docs:
        assert Path(task.doc_to_visual(doc)[0]).is_file()
        assert task.doc_to_target(doc) == doc["answer"]
        assert doc["question"] in task.doc_to_text(doc)
        assert task.process_results(doc, [f"({doc['answer']})"])["accuracy"]["right"] == 1.0
    assert docs[0]["text"] in tasks["phase_questions_text"].doc_to_text(docs[0])


def lm_eval():
    from lm_eval import simple_evaluate
    from lm_eval.tasks import TaskManager

    manager = TaskManager(include_path=str(ROOT / "lm_eval"), include_defaults=False)
    found = simple_evaluate(model="dummy", tasks=["phase_questions_text"], task_manager=manager, bootstrap_iters=0)
    assert 0.0 <= found["results"]["phase_questions_text"]["acc,none"] <= 1.0


for check, needed in ((hugging_face, True), (inspect, True), (lmms_eval, False), (lm_eval, False)):
    try:
        check()
        print(f"{check.__name__}: loaded, {len(LINES)} questions")
    except ImportError as error:
        if needed:
            raise
        print(f"{check.__name__}: skipped, {error}")
