//! Changed copies of a model: the first line is a path, the second a value, the rest the text of the model.

use quasirigid_io::model::{KeyPath, KeyValue, Template, changed};

pub fn change(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let mut parts = text.splitn(3, '\n');
    let (Some(path), Some(value), Some(model)) = (parts.next(), parts.next(), parts.next()) else { return };
    let given = value.parse().map_or_else(|_| KeyValue::from(value), KeyValue::Number);
    let given = if value.starts_with('[') { KeyValue::List(vec![given]) } else { given };
    match changed(model, &[(path, given.clone())]) {
        Ok(copy) => {
            let again = Template::new(&copy).expect("a changed copy is TOML");
            let path: KeyPath = path.parse().expect("the path was followed");
            let found = again.find(&path);
            assert!(found.is_ok(), "the path leads to its value in the copy: {found:?}");
            assert_eq!(
                again.changed(&[(path, given)]).as_deref(),
                Ok(copy.as_str()),
                "a change twice is a change once"
            );
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
