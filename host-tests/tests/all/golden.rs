//! Reading the tabulated friction cases.

use serde_json::Value;

pub fn list(name: &str) -> Vec<Value> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/golden/friction.json"));
    let all: Value = serde_json::from_str(text).unwrap();
    all[name].as_array().unwrap().clone()
}

pub fn number(case: &Value, name: &str) -> f64 {
    case[name].as_f64().unwrap()
}

pub fn numbers(case: &Value, name: &str) -> Vec<f64> {
    case[name]
        .as_array()
        .unwrap()
        .iter()
        .map(|value| value.as_f64().unwrap())
        .collect()
}
