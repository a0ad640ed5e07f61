"""The examples run."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parent.parent / "examples"
ROOT = EXAMPLES.parent.parent.parent


def test_two_minds(tmp_path):
    done = subprocess.run(
        [sys.executable, EXAMPLES / "two_minds.py", tmp_path], capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 0, done.stderr
    assert "goals recognised" in done.stdout
    assert (tmp_path / "event.mp4").stat().st_size > 1000


@pytest.mark.parametrize("document", ["crates/phase-python/README.md", "docs/how-to/method.md"])
def test_the_code_of_documents(document, tmp_path):
    """Every Python block runs, one after the other, in an empty folder."""
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / document).read_text(), flags=re.DOTALL)
    assert blocks
    command = [sys.executable, "-c", "\n".join(blocks)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=600)
    assert done.returncode == 0, done.stderr
    assert "'value': " in done.stdout


def test_learning_to_help(tmp_path):
    """Two updates of PPO, and the comparison with other helpers."""
    pytest.importorskip("torch")
    command = [sys.executable, EXAMPLES / "learn_to_help.py", "--seconds", "1", "--out", tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr
    document = json.loads((tmp_path / "curve.json").read_text())
    means = {name: sum(numbers) / len(numbers) for name, numbers in document["finals"].items()}
    # The agent that is to be helped cannot do it alone, and a mind that wants to help does.
    assert means["nobody"] == 0
    assert means["PHASE mind"] > means["learned"]
    assert means["PHASE mind"] > 30
    assert (tmp_path / "curve.png").stat().st_size > 1000


def test_learning_with_stable_baselines3():
    """It learns: from never being on the landmark to most of the 80 steps. And it is what the page shows."""
    page = EXAMPLES.parents[2] / "docs/how-to/reinforcement-learning.md"
    program = EXAMPLES / "learn_with_sb3.py"
    assert program.read_text().partition('"""\n\n')[2].rstrip() in page.read_text()
    pytest.importorskip("stable_baselines3", reason="stable-baselines3 is not installed")
    done = subprocess.run([sys.executable, program, "25000"], capture_output=True, text=True, check=False, timeout=600)
    assert done.returncode == 0, done.stderr
    returns = [float(line.rsplit(" ", 1)[1]) for line in done.stdout.splitlines()]
    assert returns[0] < 0 and returns[-1] > 50, done.stdout


def test_throughput():
    """Every row is measured."""
    command = [sys.executable, EXAMPLES / "steps_per_second.py", "--seconds", "0.01", "--only", "learning"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr
    measured = json.loads(done.stdout.splitlines()[-1])
    assert len(measured) == 14 and all(number > 0 for number in measured.values())


def test_the_tutorial(tmp_path):
    """The notebook runs from its first to its last cell."""
    pytest.importorskip("nbmake")
    shutil.copy(EXAMPLES / "tutorial.ipynb", tmp_path)
    command = [sys.executable, "-m", "pytest", "-q", "--nbmake", "tutorial.ipynb"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=600)
    assert done.returncode == 0, done.stdout


def test_the_command_line(tmp_path):
    def phase(*arguments):
        return subprocess.run([sys.executable, "-m", "phase_events", *arguments], capture_output=True, text=True, check=False)

    done = phase("new-scene", "--out", str(tmp_path / "scene.json"))
    assert done.returncode == 0, done.stderr
    wrong = phase("verify", str(tmp_path / "nowhere"))
    assert wrong.returncode == 2
    assert wrong.stderr.startswith("error: ")
