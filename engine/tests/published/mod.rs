//! Reading the published tables that the blast tests compare with.

#![allow(dead_code)] // Each test file uses a part of it.

/// Parses a JSON document.
pub fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap()
}

/// The rows of a CSV text with a header: each a look-up of a number by column name, `None` where it is empty.
pub fn rows(text: &str) -> Vec<impl Fn(&str) -> Option<f64> + '_> {
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines
        .map(|line| {
            let (header, cells) = (header.clone(), line.split(',').collect::<Vec<_>>());
            move |name: &str| {
                let column = header.iter().position(|column| *column == name);
                cells[column.unwrap_or_else(|| panic!("no column {name}"))].parse().ok()
            }
        })
        .collect()
}

/// `count` values from `first` to `last`, evenly spaced on a logarithmic scale.
pub fn log_spaced(first: f64, last: f64, count: usize) -> Vec<f64> {
    let ratio = (last / first).ln();
    (0..count)
        .map(|step| match step {
            0 => first,
            step if step == count - 1 => last,
            step => first * (ratio * step as f64 / (count - 1) as f64).exp(),
        })
        .collect()
}
