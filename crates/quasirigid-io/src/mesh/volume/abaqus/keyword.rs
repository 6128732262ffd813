use super::VolumeProblem;

/// A keyword line, `*NAME, KEY=value, KEY`; capitals and blanks do not matter in names and keys.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Keyword<'a> {
    /// In capitals.
    pub(super) name: String,
    /// Keys in capitals, and values.
    pub(super) parameters: Vec<(String, &'a str)>,
}

impl<'a> Keyword<'a> {
    /// A line after its asterisk.
    pub(super) fn new(line: &'a str) -> Self {
        let mut fields = line.split(',');
        let name = capitals(fields.next().unwrap_or_default());
        let parameter = |field: &'a str| {
            let (key, value) = field.split_once('=').unwrap_or((field, ""));
            (capitals(key), value.trim().trim_matches('"'))
        };
        Self { name, parameters: fields.map(parameter).collect() }
    }

    /// The value of a parameter; empty where it has none.
    pub(super) fn parameter(&self, key: &str) -> Option<&'a str> {
        self.parameters.iter().find(|(name, _)| name == key).map(|(_, value)| *value)
    }

    /// The value of a parameter that must be there.
    pub(super) fn needs(&self, key: &str) -> Result<&'a str, VolumeProblem> {
        let lacks =
            || VolumeProblem::Parameter { keyword: self.name.clone().into(), parameter: key.to_owned() };
        self.parameter(key).filter(|value| !value.is_empty()).ok_or_else(lacks)
    }
}

fn capitals(name: &str) -> String {
    name.split_whitespace().collect::<Vec<_>>().join(" ").to_ascii_uppercase()
}

#[cfg(test)]
mod tests {
    use super::Keyword;

    #[test]
    fn capitals_and_blanks_do_not_matter() {
        let keyword = Keyword::new("Node  print , nset = \"Outer Face\",Generate");
        assert_eq!(keyword.name, "NODE PRINT");
        assert_eq!(keyword.parameter("NSET"), Some("Outer Face"));
        assert_eq!(keyword.parameter("GENERATE"), Some(""));
        assert_eq!(keyword.parameter("ELSET"), None);
    }
}
