"""The API pages are made of the docstrings, and nothing public is without one."""

import importlib.util
import inspect
import pkgutil
import subprocess
import sys

import pytest

import phase_events

pytest.importorskip("pdoc")

# A module that needs what is not installed has no page here.
OPTIONAL = {"phase_events.torch": "torch", "phase_events.ray": "ray"}


def modules():
    found = [f"phase_events.{one.name}" for one in pkgutil.iter_modules(phase_events.__path__)]
    return ["phase_events", *(name for name in found if not name.rsplit(".", 1)[1].startswith("_"))]


def public(module):
    """Functions and classes that a module defines, and their methods."""
    for name, item in vars(module).items():
        own = getattr(item, "__module__", "").startswith("phase_events")
        if name.startswith("_") or not own or not (inspect.isclass(item) or inspect.isroutine(item)):
            continue
        yield f"{module.__name__}.{name}", item
        if inspect.isclass(item):
            for method, value in vars(item).items():
                if not method.startswith("_") and (callable(value) or isinstance(value, property)):
                    yield f"{module.__name__}.{name}.{method}", value


@pytest.mark.parametrize("name", modules())
def test_everything_public_is_documented(name):
    if name in OPTIONAL:
        pytest.importorskip(OPTIONAL[name])
    module = importlib.import_module(name)
    assert (module.__doc__ or "").strip()
    undocumented = [where for where, item in public(module) if not (inspect.getdoc(item) or "").strip()]
    assert not undocumented


def test_pages(tmp_path):
    present = [name for name in modules() if name not in OPTIONAL or importlib.util.find_spec(OPTIONAL[name])]
    command = [sys.executable, "-m", "pdoc", "--docformat", "google", "-o", str(tmp_path), *present]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr
    assert "Warn" not in done.stderr
    page = (tmp_path / "phase_events" / "env.html").read_text()
    assert "PhaseParallelEnv" in page
    assert "Equation 1" in page
