//! Raters' answers that are published as counts.

use crate::import_socialgnn::{assert_refused, import, json_of, made_up, python};
use serde_json::json;

/// Answers that are counted already come as a table of pandas, which need not be installed.
#[test]
fn counted_answers_are_read_without_pandas() {
    let Some(folder) = made_up() else { return };
    let folder = folder.path();
    // What pandas 1.5 and 2.2 write, by classes of the same names.
    let script = r#"
import pickle, sys, types
import numpy
from collections import Counter
def thing(module, name, make):
    for k in range(1, module.count(".") + 2):
        part = ".".join(module.split(".")[:k])
        sys.modules.setdefault(part, types.ModuleType(part))
    made = make(name)
    made.__module__, made.__qualname__, made.__name__ = module, name, name
    setattr(sys.modules[module], name, made)
    return made
kind = lambda name: type(name, (), {})
called = lambda name: lambda *given: None
Frame = thing("pandas.core.frame", "DataFrame", kind)
Index = thing("pandas.core.indexes.base", "Index", kind)
new_index = thing("pandas.core.indexes.base", "_new_Index", called)
Manager = thing("pandas.core.internals.managers", "BlockManager", kind)
block = thing("pandas._libs.internals", "_unpickle_block", called)
class Call:
    def __init__(self, *made): self.made = made
    def __reduce__(self): return self.made
def index(name, labels):
    data = numpy.empty(len(labels), object)
    data[:] = labels
    return Call(new_index, (Index, {"data": data, "name": name}))
def table(counts, rows="videos", column="relationship", length=None):
    values = numpy.empty((1, len(counts)), object)
    values[0, :] = [Counter(it) for it in counts.values()]
    blocks = (Call(block, (values, slice(0, 1, 1), 2)),)
    axes = [index(None, [column]), index(rows, list(counts)[:length])]
    frame = Frame()
    frame.__dict__ = {"_mgr": Call(Manager, (blocks, axes)), "_typ": "dataframe", "_metadata": [], "attrs": {}}
    return frame
names = [entry["name"] for entry in pickle.load(open("recordings.pkl", "rb")) if entry]
sound = {names[0]: {"friendly": 11, "adversarial": 2}, names[1]: {"neutral": 10}, "elsewhere.mp4": {"neutral": 1}}
def keep(file, content):
    pickle.dump(content, open(file, "wb"), protocol=4)
keep("counted", table(sound))
keep("mood", table({names[0]: {"angry": 1}}))
keep("negative", table({names[0]: {"friendly": -1}}))
keep("elsewhere", table({"elsewhere.mp4": {"neutral": 1}}))
keep("agreement", table(sound, column="agreement"))
keep("films", table(sound, rows="films"))
keep("short", table(sound, length=2))
keep("plain", {names[0]: {"friendly": 1}})
keep("list", [sound])
"#;
    let output = python(folder, script).expect("it was there before");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let given =
        |file: &'static str| ["recordings.pkl", "out.json", "--counted", file, "--ratings", "ratings.json"];
    for (file, wanted) in [
        ("mood", "must count friendly, neutral, adversarial"),
        ("negative", "must count friendly, neutral, adversarial, each 0 to 1000"),
        ("elsewhere", "has no answers about these recordings"),
        ("agreement", "the column `relationship`"),
        ("films", "the rows `videos`"),
        ("short", "has 2 rows and 3 values"),
        ("plain", "must be a table of pandas"),
        ("list", "must be a table of pandas"),
    ] {
        assert_refused(folder, &given(file), wanted);
    }
    let output = import(folder, &given("counted"));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let wanted = json!({
        "phase-test-000": { "friendly": 11, "neutral": 0, "adversarial": 2 },
        "phase-test-002": { "friendly": 0, "neutral": 10, "adversarial": 0 },
    });
    assert_eq!(json_of(&folder.join("ratings.json"))["ratings"], wanted);
}
