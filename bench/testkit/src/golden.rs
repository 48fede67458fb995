//! Reading the golden cases.

use serde_json::Value;

/// A file of `golden`.
pub fn file(name: &str) -> Value {
    let path = format!(
        "{}/../../host-tests/golden/{name}.json",
        env!("CARGO_MANIFEST_DIR")
    );
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// A list of cases of a file.
pub fn cases(file_name: &str, list: &str) -> Vec<Value> {
    file(file_name)[list].as_array().unwrap().clone()
}

/// A list of cases of `friction`.
pub fn list(name: &str) -> Vec<Value> {
    cases("friction", name)
}

/// A number of a case.
pub fn number(case: &Value, name: &str) -> f64 {
    case[name].as_f64().unwrap()
}

/// Numbers of a case.
pub fn numbers(case: &Value, name: &str) -> Vec<f64> {
    list_of(&case[name])
}

/// The numbers of a list.
pub fn list_of(value: &Value) -> Vec<f64> {
    let numbers = value.as_array().unwrap().iter();
    numbers.map(|number| number.as_f64().unwrap()).collect()
}
