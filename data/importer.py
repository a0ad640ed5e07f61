"""What the importers beside this file share: reading pickles that others made, and writing files whole.

A pickle is a program: it may name any function to be called, and any attribute to be
set. So a file is read by a process of its own, with limits on memory and time, which looks nothing up: the names
admitted stand here with what they mean. That process tells its answer as JSON; nothing else of it survives.

An importer calls itself for each file (`ask`, `answer`).
"""

import collections
import json
import os
import pickle
import stat
import subprocess
import sys
import tempfile

try:
    import resource
except ImportError:  # Only Unix has limits on memory.
    resource = None

# Address space that the reading process may take beyond what Python and numpy take, and its time.
READ_MEMORY_BYTES = 1 << 30
READ_SECONDS = 60
# How much of a foreign text an error message repeats.
SHOWN_CHARACTERS = 100
# An importer calls itself with this argument to read one file.
READ_ARGUMENT = "--read-in-this-process"

EXIT_FAILURE = 1
EXIT_BAD_INPUT = 2


class Unusable(Exception):
    """Input that cannot be converted; the text is one plain sentence."""


class Failure(Exception):
    """Something other than the input that went wrong; the text is one plain sentence."""


def shown(value):
    """A foreign text for a sentence: on one line, short, in ASCII."""
    text = ascii(str(value))[1:-1]
    return text if len(text) <= SHOWN_CHARACTERS else text[:SHOWN_CHARACTERS] + "..."


def printable(text):
    """A text without characters that steer a terminal, turn its order around or have no form in bytes."""
    escaped = lambda letter: letter.encode("unicode_escape").decode("ascii")
    return "".join(letter if letter.isprintable() else escaped(letter) for letter in text)


def tell(line):
    """Prints a result. One that nobody gets is none."""
    try:
        print(printable(line), flush=True)
    except OSError as error:
        # What is left in the buffer would be tried again at the end.
        sys.stdout = None
        raise Failure(f"the result cannot be written to stdout: {error.strerror}") from error


def main_of(run, *arguments):
    """Runs an importer to its exit code; errors are one plain sentence each."""
    try:
        run(*arguments)
    except (Unusable, Failure) as error:
        print(printable(f"error: {error}"), file=sys.stderr)
        sys.exit(EXIT_BAD_INPUT if isinstance(error, Unusable) else EXIT_FAILURE)


def read_json(line):
    """JSON without names that an object has twice: which of them counts differs from reader to reader."""
    def members(pairs):
        result = dict(pairs)
        if len(result) < len(pairs):
            names = [name for name, _ in pairs]
            raise Unusable(f"has the member `{shown(next(name for name in names if names.count(name) > 1))}` twice")
        return result
    try:
        return json.loads(line, object_pairs_hook=members)
    except (ValueError, RecursionError) as error:
        raise Unusable("is no JSON") from error


def import_numpy():
    """numpy, or None where it is not installed."""
    # One thread needs less address space; nothing is computed here.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    try:
        import numpy
    except ImportError:
        return None
    return numpy


def latin1(text, encoding):
    """How pickles of the second protocol hold bytes."""
    if encoding != "latin1":
        raise pickle.UnpicklingError(f"it asks for the encoding {shown(encoding)}, which bytes do not have")
    return text.encode("latin1")


def admitted_names():
    """Everything that plain data and numpy arrays need, by module and name."""
    names = {
        ("_codecs", "encode"): latin1,
        ("collections", "Counter"): collections.Counter,
        ("collections", "OrderedDict"): collections.OrderedDict,
        ("collections", "defaultdict"): collections.defaultdict,
    }
    for module in ("builtins", "__builtin__"):
        # What a defaultdict makes, and sets, which old protocols make by a call.
        names.update({(module, kind.__name__): kind for kind in (dict, float, int, list, set, slice)})
    names.update({name: Recorded for name in PANDAS_NAMES})
    names.update(numpy_names())
    return names


class Recorded:
    """What a pickle hands to something of pandas, which is not called: a table is read without pandas, whose versions
    do not read each other's pickles."""

    given = ()

    def __init__(self, *given):
        self.given = given

    def __setstate__(self, state):
        self.given += (state,)


# What a table of texts and plain data needs, by module and name, in pandas 1 and 2.
PANDAS_NAMES = [
    ("pandas.core.frame", "DataFrame"), ("pandas.core.internals.managers", "BlockManager"),
    ("pandas._libs.internals", "_unpickle_block"), ("pandas.core.indexes.base", "_new_Index"),
    ("pandas.core.indexes.base", "Index"),
]


def parts_of(value):
    """All that a recorded value is made of, itself first. Arrays are not taken apart."""
    seen, waiting = set(), [value]
    while waiting:
        part = waiting.pop()
        if id(part) in seen:
            continue
        seen.add(id(part))
        yield part
        if isinstance(part, Recorded):
            waiting.extend(reversed(part.given))
        elif isinstance(part, (list, tuple)):
            waiting.extend(reversed(part))
        elif isinstance(part, dict):
            waiting.extend(reversed(list(part.values())))


def column_of(table, index, column, kind):
    """The only column of a table of pandas as pairs of a row's name and a value of a kind."""
    numpy = import_numpy()
    arrays, names = [], {}
    for part in parts_of(table):
        if isinstance(part, numpy.ndarray) and part.dtype == object:
            arrays.append(part)
        elif isinstance(part, dict) and isinstance(part.get("data"), numpy.ndarray):
            names[part.get("name")] = part["data"]
    columns = [labels for name, labels in names.items() if name != index]
    values = [array for array in arrays if array.size and all(isinstance(it, kind) for it in array.flat)]
    rows = names.get(index)
    if rows is None or len(values) != 1 or not any(list(labels.flat) == [column] for labels in columns):
        raise Unusable(f"must be a table of pandas with the rows `{index}` and the column `{column}`")
    if values[0].size != rows.size:
        raise Unusable(f"has {rows.size} rows and {values[0].size} values")
    return list(zip(rows.flat, values[0].flat))


def numpy_names():
    """What numpy arrays need; each is None where numpy is not installed."""
    names = {("numpy", "ndarray"): None, ("numpy", "dtype"): None}
    for package in ("numpy.core", "numpy._core"):
        names.update({(f"{package}.multiarray", name): None for name in ("_reconstruct", "scalar")})
        names[f"{package}.numeric", "_frombuffer"] = None
    numpy = import_numpy()
    if numpy is None:
        return names
    try:
        from numpy._core import multiarray, numeric
    except ImportError:  # numpy before 2.0
        from numpy.core import multiarray, numeric
    found = {"numpy": numpy, "multiarray": multiarray, "numeric": numeric}
    return {(module, name): getattr(found[module.split(".")[-1]], name) for module, name in names}


def load(stream):
    """The content of a pickle of plain data and numpy arrays; also of Python 2, whose texts are bytes."""
    admitted = admitted_names()

    class PlainUnpickler(pickle.Unpickler):
        def find_class(self, module, name):
            if (module, name) not in admitted:
                raise pickle.UnpicklingError(f"it asks for {module}.{name}, which is no plain data")
            if admitted[module, name] is None:
                raise Failure("numpy is needed to read the recordings")
            return admitted[module, name]

    return PlainUnpickler(stream, encoding="latin1").load()


def open_regular(path, largest):
    """A regular file, open; pipes and devices may never end."""
    # Not to wait for whoever writes into a pipe.
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    state = os.fstat(descriptor)
    if not stat.S_ISREG(state.st_mode):
        os.close(descriptor)
        raise Unusable("is no regular file")
    if state.st_size > largest:
        os.close(descriptor)
        raise Unusable(f"is larger than {largest} bytes")
    return os.fdopen(descriptor, "rb")


def content_of(path, largest):
    """The content of a file of at most so many bytes."""
    return contents_of(path, largest, 1)[0]


def contents_of(path, largest, count):
    """The contents of so many pickles, one after the other in a file of at most so many bytes."""
    try:
        with open_regular(path, largest) as stream:
            return [load(stream) for _ in range(count)]
    except (Unusable, Failure, MemoryError):
        raise
    except OSError as error:
        raise Unusable(f"cannot be read: {error.strerror}") from error
    except Exception as error:  # A damaged pickle may fail in any way.
        raise Unusable(f"is no pickle of plain data: {shown(error) or type(error).__name__}") from error


def limit_memory():
    """Limits what this process may take from now on; numpy must have been imported."""
    if resource is None:
        return
    try:
        with open("/proc/self/statm", encoding="ascii") as stream:
            taken = int(stream.read().split()[0]) * resource.getpagesize()
    except (OSError, ValueError):  # Not Linux.
        taken = 0
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    limit = taken + READ_MEMORY_BYTES
    if hard != resource.RLIM_INFINITY:
        limit = min(limit, hard)
    try:
        resource.setrlimit(resource.RLIMIT_AS, (limit, hard))
    except (ValueError, OSError):  # Some systems know this limit by name only.
        pass


def answer(convert, *arguments):
    """The reading process: prints what `convert` returns for the arguments as one JSON object."""
    try:
        import_numpy()
        limit_memory()
        text = json.dumps({"converted": convert(*arguments)}, allow_nan=False)
    except Unusable as error:
        text = json.dumps({"unusable": str(error)})
    except Failure as error:
        text = json.dumps({"failure": str(error)})
    except (MemoryError, RecursionError):
        text = json.dumps({"unusable": f"takes more than {READ_MEMORY_BYTES} bytes of memory to read"})
    except ValueError:
        text = json.dumps({"unusable": "holds a number that is not finite"})
    # Written as bytes: what a file holds must not depend on the system's encoding.
    sys.stdout.buffer.write(text.encode("ascii"))


def ask(script, path, *arguments):
    """What `answer` tells of a file, found by a process of its own that runs the importer `script`."""
    command = [sys.executable, os.path.abspath(script), READ_ARGUMENT, os.path.abspath(path), *arguments]
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              timeout=READ_SECONDS, check=False)
    except subprocess.TimeoutExpired as error:
        raise Unusable(f"{path}: takes more than {READ_SECONDS} s to read") from error
    except OSError as error:
        raise Failure(f"the process that reads {path} cannot be started: {error.strerror}") from error
    try:
        told = json.loads(done.stdout)
    except ValueError as error:
        # An array made up in bad faith may crash numpy.
        raise Unusable(f"{path}: the process that reads it ended with code {done.returncode}") from error
    if "failure" in told:
        raise Failure(told["failure"])
    if "unusable" in told:
        raise Unusable(f"{path}: {told['unusable']}")
    return told["converted"]


def save(content, path):
    """A file of JSON that is there whole or not at all."""
    save_text(json.dumps(content, allow_nan=False) + "\n", path)


def save_text(line, path):
    """A file that is there whole or not at all. Devices and pipes stay what they are."""
    if os.path.exists(path) and not os.path.isfile(path) or is_descriptor(path):
        raise Failure(f"{path}: cannot be written: what has this name is no regular file")
    part = None
    try:
        descriptor, part = tempfile.mkstemp(dir=os.path.dirname(os.path.abspath(path)), prefix=".import-")
        with os.fdopen(descriptor, "w", encoding="utf-8") as stream:
            stream.write(line)
        # Like a file that is opened for writing, not for its owner alone.
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(part, 0o666 & ~mask)
        os.replace(part, path)
    except OSError as error:
        if part and os.path.exists(part):
            os.unlink(part)
        raise Failure(f"{path}: cannot be written: {error.strerror}") from error


def is_descriptor(path):
    """Whether a path is the name of something that this process has open, such as /dev/stdout."""
    return os.path.islink(path) and os.fspath(os.readlink(path)).startswith("/proc")


def is_reading(arguments):
    """Whether a process with these arguments was started to read one file."""
    return len(arguments) > 1 and arguments[1] == READ_ARGUMENT
