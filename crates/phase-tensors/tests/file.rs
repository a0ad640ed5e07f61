//! Files of tensors: what is written is read back, damaged files are rejected.

use phase_tensors::{NamedTensor, TensorFile, TensorsError, write};
use proptest::prelude::*;

fn tensor(name: &str, shape: &[usize], values: &[f32]) -> NamedTensor {
    NamedTensor { name: name.into(), shape: shape.into(), values: values.into() }
}

fn example() -> Vec<NamedTensor> {
    vec![tensor("weight", &[2, 3], &[1.0, -2.0, 0.5, 0.0, 1e-30, 7.0]), tensor("bias", &[2], &[3.0, -0.0])]
}

#[test]
fn what_is_written_is_read() {
    let bytes = write(&example(), "format", "example/1").unwrap();
    assert_eq!(bytes, write(&example(), "format", "example/1").unwrap());
    let file = TensorFile::open_as(&bytes, "format", "example/1").unwrap();
    assert_eq!(file.metadata_value(), Some("example/1"));
    file.check_names(|name| name == "weight" || name == "bias").expect("these are all");
    assert!(matches!(
        file.check_names(|name| name == "weight"),
        Err(TensorsError::Unknown(name)) if name == "bias"
    ));
    let mut names: Vec<&str> = file.names().collect();
    names.sort_unstable();
    assert_eq!(names, ["bias", "weight"]);
    for tensor in example() {
        assert!(file.has(&tensor.name));
        assert_eq!(file.values(&tensor.name, &tensor.shape).unwrap(), tensor.values);
        assert_eq!(file.tensor(&tensor.name).unwrap(), tensor);
    }
}

#[test]
fn what_is_not_there_or_of_another_kind_is_refused() {
    let bytes = write(&example(), "format", "example/1").unwrap();
    let kind = |field, expected: &str| TensorFile::open_as(&bytes, field, expected).err();
    for (field, expected) in [("format", "example/2"), ("training", "example/1")] {
        let refused = kind(field, expected).expect("another kind").to_string();
        assert_eq!(refused, format!("field `{field}` must be {expected:?}"));
    }
    assert_eq!(TensorFile::open(&bytes, "training").unwrap().metadata_value(), None);
    let file = TensorFile::open(&bytes, "format").unwrap();
    assert!(!file.has("scale"));
    assert!(matches!(file.tensor("scale"), Err(TensorsError::Missing(name)) if name == "scale"));
    let refused = file.values("weight", &[3, 2]).unwrap_err().to_string();
    assert_eq!(refused, "tensor `weight` must have the shape [3, 2], not [2, 3]");
}

#[test]
fn numbers_that_are_none_and_other_types_are_refused() {
    for number in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let bytes = write(&[tensor("bias", &[2], &[1.0, number])], "format", "example/1").unwrap();
        let file = TensorFile::open(&bytes, "format").unwrap();
        assert!(matches!(file.tensor("bias"), Err(TensorsError::NotFinite(name)) if name == "bias"));
    }
    let mut bytes = write(&[tensor("bias", &[1], &[1.0])], "format", "example/1").unwrap();
    let at = bytes.windows(3).position(|part| part == b"F32").unwrap();
    bytes[at..at + 3].copy_from_slice(b"I32");
    let file = TensorFile::open(&bytes, "format").unwrap();
    assert!(matches!(file.tensor("bias"), Err(TensorsError::Type(name)) if name == "bias"));
}

#[test]
fn shapes_that_do_not_go_with_their_numbers_are_not_written() {
    let outcome = write(&[tensor("bias", &[3], &[1.0])], "format", "example/1");
    assert!(matches!(outcome, Err(TensorsError::Container(_))), "{outcome:?}");
}

proptest! {
    // Keep no file of past failures beside the tests.
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_files_never_panic(at in 0_usize..400, byte: u8, length in 0_usize..400) {
        let mut bytes = write(&example(), "format", "example/1").unwrap();
        let at = at % bytes.len();
        bytes[at] = byte;
        bytes.truncate(length.max(at));
        if let Ok(file) = TensorFile::open(&bytes, "format") {
            for name in file.names() {
                if let Ok(tensor) = file.tensor(name) {
                    prop_assert_eq!(tensor.shape.iter().product::<usize>(), tensor.values.len());
                }
            }
        }
    }
}
