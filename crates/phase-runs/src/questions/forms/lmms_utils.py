"""Questions of PHASE for lmms-eval."""

import os
import re
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
FOLDERS = {"first-frame": "videos-first-frame", "shuffled": "videos-shuffled", "reversed": "videos-reversed"}


def _control(kwargs):
    return (kwargs or {}).get("control", "video")


def doc_to_visual(doc, lmms_eval_specific_kwargs=None):
    control = _control(lmms_eval_specific_kwargs)
    if control in ("no-video", "text"):
        return []
    folder = FOLDERS.get(control, "videos")
    path = HERE / folder / doc["video"]
    if not path.exists():
        home = Path(os.path.expanduser(os.getenv("HF_HOME", "~/.cache/huggingface")))
        path = home / "phase_questions" / folder / doc["video"]
    if not path.exists():
        raise FileNotFoundError(f"{path}: the video of question {doc['question_id']} is missing")
    return [str(path)]


def _options(doc, control):
    return doc["options_none"] if control == "none-of-these" else doc["options"]


def doc_to_text(doc, lmms_eval_specific_kwargs=None):
    kwargs = lmms_eval_specific_kwargs or {}
    control = _control(kwargs)
    parts = [] if control == "no-video" else [doc["introduction"], ""]
    if control == "text":
        parts += [doc["text"], ""]
    parts.append(doc["question"])
    parts += [f"{chr(65 + k)}. {text}" for k, text in enumerate(_options(doc, control))]
    return kwargs.get("pre_prompt", "") + "\n".join(parts) + kwargs.get("post_prompt", "")


def parse(answer, options):
    """The option that an answer names: a letter alone, after "answer", or the text of one option; else None."""
    answer = answer.strip()
    last = chr(64 + len(options))
    found = re.match(rf"^[\s(\[*\"']*([A-{last}])(?:[\s.):\],*\"']|$)(?!\w)", answer)
    found = found or re.search(rf"answer\s*(?:is|:)?\s*[(\[*\"']*([A-{last}])\b", answer, re.IGNORECASE)
    if found:
        return ord(found.group(1).upper()) - 65
    named = [k for k, text in enumerate(options) if re.search(rf"(?<!\w){re.escape(text)}(?!\w)", answer, re.IGNORECASE)]
    return named[0] if len(named) == 1 else None


def process_results(doc, results):
    right = parse(results[0], doc["options"]) == doc["answer_index"]
    entry = {"right": float(right), "task": doc["task"], "frames": doc["frames"]}
    return {"accuracy": entry, "accuracy_by_task": entry, "accuracy_by_frames": entry}


def accuracy(entries):
    return sum(entry["right"] for entry in entries) / len(entries)


def _by(entries, key):
    groups = {}
    for entry in entries:
        groups.setdefault(entry[key], []).append(entry)
    for name, group in sorted(groups.items()):
        print(f"{key} {name}: {accuracy(group):.3f} of {len(group)}")
    return sum(accuracy(group) for group in groups.values()) / len(groups)


def accuracy_by_task(entries):
    """The mean over types of questions; each type is printed."""
    return _by(entries, "task")


def accuracy_by_frames(entries):
    """The mean over certified numbers of frames (0 all, -1 not certified); each is printed."""
    return _by(entries, "frames")
