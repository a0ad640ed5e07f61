"""Questions of PHASE for Inspect.

    inspect eval inspect/phase_questions.py --model PROVIDER/MODEL
    inspect eval inspect/phase_questions.py -T frames=16 -T control=shuffled --model …

`frames` shows so many pictures in place of the video, for providers that take none; it needs `av` and `pillow`.
"""

import io
import base64
import json
from pathlib import Path

from inspect_ai import Task, task
from inspect_ai.dataset import MemoryDataset, Sample
from inspect_ai.model import ChatMessageUser, ContentImage, ContentText, ContentVideo
from inspect_ai.scorer import accuracy, choice, grouped, stderr
from inspect_ai.solver import multiple_choice

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = {"first-frame": "videos-first-frame", "shuffled": "videos-shuffled", "reversed": "videos-reversed"}
CONTROLS = ["video", "no-video", "first-frame", "shuffled", "reversed", "text", "none-of-these"]


def pictures(path, count):
    """So many frames of a video, uniformly spaced from the first to the last, as PNG."""
    import av

    with av.open(str(path)) as video:
        frames = [frame.to_image() for frame in video.decode(video=0)]
    last = len(frames) - 1
    shown = range(len(frames)) if count > last else [(2 * k * last + count - 1) // (2 * (count - 1)) for k in range(count)]
    for k in shown:
        data = io.BytesIO()
        frames[k].save(data, format="PNG")
        yield ContentImage(image="data:image/png;base64," + base64.b64encode(data.getvalue()).decode())


def sample(line, control, frames, texts):
    metadata = line["metadata"]
    words = line["input"][0]["content"][1]["text"]
    content = []
    if control == "no-video":
        words = metadata["question"]
    elif control == "text":
        words = texts[line["id"]] + "\n\n" + words
    else:
        path = ROOT / FOLDERS.get(control, "videos") / (metadata["video"] + ".mp4")
        content = list(pictures(path, frames)) if frames else [ContentVideo(video=str(path), format="mp4")]
    choices = metadata["options_none"] if control == "none-of-these" else line["choices"]
    content.append(ContentText(text=words))
    # The prompt of multiple_choice holds the text of the last message alone; what is shown is a message of its own.
    shown = [ChatMessageUser(content=content[:-1])] if len(content) > 1 else []
    return Sample(
        id=line["id"], input=shown + [ChatMessageUser(content=words)], choices=choices, target=line["target"],
        metadata={"task": metadata["task"], "frames": str(metadata["frames"])},
    )


@task
def phase_questions(control: str = "video", frames: int = 0, only: str = ""):
    """`control` is one of CONTROLS, `frames` the number of pictures in place of the video, `only` a type."""
    if control not in CONTROLS:
        raise ValueError(f"control: must be one of {', '.join(CONTROLS)}, not {control}")
    lines = [json.loads(line) for line in (ROOT / "inspect" / "phase_questions.jsonl").read_text().splitlines()]
    texts = {}
    if control == "text":
        rows = (ROOT / "lmms_eval" / "questions.jsonl").read_text().splitlines()
        texts = {row["question_id"]: row["text"] for row in map(json.loads, rows)}
    wanted = [line for line in lines if not only or line["metadata"]["task"] == only]
    return Task(
        dataset=MemoryDataset([sample(line, control, frames, texts) for line in wanted]),
        solver=multiple_choice(),
        scorer=choice(),
        metrics=[grouped(accuracy(), "task"), stderr()],
    )
