"""Questions of PHASE for VLMEvalKit: copy to vlmeval/dataset/, import PHASEQuestions in vlmeval/dataset/__init__.py, add it
to VIDEO_DATASET, and its names to vlmeval/dataset/video_dataset_config.py:

    phase_questions_dataset = {
        f"PHASE-Questions_{n}frame": partial(PHASEQuestions, dataset="PHASE-Questions", nframe=n) for n in (8, 16, 32, 64)
    } | {"PHASE-Questions_1fps": partial(PHASEQuestions, dataset="PHASE-Questions", fps=1.0)}

PHASE_QUESTIONS is the folder of the benchmark.
"""

import json
import os
import os.path as osp
import re

from vlmeval.dataset.video_base import VideoBaseDataset
from vlmeval.smp import dump, load


class PHASEQuestions(VideoBaseDataset):
    TYPE = "Video-MCQ"

    def __init__(self, dataset="PHASE-Questions", nframe=0, fps=-1):
        super().__init__(dataset=dataset, nframe=nframe, fps=fps)

    @classmethod
    def supported_datasets(cls):
        return ["PHASE-Questions"]

    def prepare_dataset(self, dataset="PHASE-Questions"):
        root = os.environ["PHASE_QUESTIONS"]
        return dict(root=osp.join(root, "videos"), data_file=osp.join(root, "vlmevalkit", f"{dataset}.tsv"))

    def build_prompt(self, line, video_llm):
        if isinstance(line, int):
            line = self.data.iloc[line]
        with open(osp.join(os.environ["PHASE_QUESTIONS"], "introduction.txt")) as file:
            message = [dict(type="text", value=file.read())]
        if video_llm:
            message.append(dict(type="video", value=osp.join(self.data_root, line["video"] + ".mp4")))
        else:
            message += [dict(type="image", value=frame) for frame in self.save_video_frames(line["video"])]
        options = json.loads(line["candidates"])
        text = [line["question"]] + [f"{chr(65 + k)}. {option}" for k, option in enumerate(options)]
        text.append("Answer with the letter of the right option alone.")
        return message + [dict(type="text", value="\n".join(text))]

    @staticmethod
    def parse(answer, options):
        """The option that an answer names: a letter alone, after "answer", or the text of one option; else None."""
        answer = str(answer).strip()
        last = chr(64 + len(options))
        found = re.match(rf"^[\s(\[*\"']*([A-{last}])(?:[\s.):\],*\"']|$)(?!\w)", answer)
        found = found or re.search(rf"answer\s*(?:is|:)?\s*[(\[*\"']*([A-{last}])\b", answer, re.IGNORECASE)
        if found:
            return found.group(1).upper()
        named = [k for k, text in enumerate(options) if re.search(rf"(?<!\w){re.escape(text)}(?!\w)", answer, re.IGNORECASE)]
        return chr(65 + named[0]) if len(named) == 1 else None

    @classmethod
    def evaluate(cls, eval_file, **judge_kwargs):
        """Accuracy of all questions and of each type, by a regular expression; there is no judge model."""
        data = load(eval_file)
        groups = {}
        for _, line in data.iterrows():
            right = cls.parse(line["prediction"], json.loads(line["candidates"])) == line["answer"]
            for name in ("all", line["dim"], f"frames {line['frames']}"):
                groups.setdefault(name, []).append(right)
        rating = {name: sum(rights) / len(rights) for name, rights in groups.items()}
        dump(rating, osp.splitext(eval_file)[0] + "_rating.json")
        return rating
