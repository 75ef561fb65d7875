//! The grammar that recipes and operators share: an id with settings.
//!
//! ```text
//! call = id [ ":" key "=" value { "," key "=" value } ]
//! ```

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

/// An id with settings; whether they mean anything is for the catalogue to say.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Call {
    /// The id.
    pub id: String,
    /// The settings that were given.
    pub settings: BTreeMap<String, String>,
}

/// Why a text is no call.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CallError {
    /// A setting that is not `key=value`.
    #[error("'{setting}' in '{call}' is not a setting; write key=value")]
    Setting {
        /// The call.
        call: String,
        /// The setting in question.
        setting: String,
    },
    /// The same key twice.
    #[error("'{key}' is set twice in '{call}'; leave one of them out")]
    Twice {
        /// The call.
        call: String,
        /// The key in question.
        key: String,
    },
}

impl FromStr for Call {
    type Err = CallError;

    fn from_str(text: &str) -> Result<Self, CallError> {
        let text = text.trim();
        let (id, rest) = text.split_once(':').unwrap_or((text, ""));
        let mut settings = BTreeMap::new();
        for setting in rest.split(',').map(str::trim).filter(|s| !s.is_empty()) {
            let (key, value) = setting
                .split_once('=')
                .map(|(key, value)| (key.trim(), value.trim()))
                .filter(|(key, value)| !key.is_empty() && !value.is_empty())
                .ok_or_else(|| CallError::Setting { call: text.into(), setting: setting.into() })?;
            if settings.insert(key.to_string(), value.to_string()).is_some() {
                return Err(CallError::Twice { call: text.into(), key: key.into() });
            }
        }
        Ok(Call { id: id.trim().to_string(), settings })
    }
}

impl fmt::Display for Call {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.id)?;
        let mut separator = ':';
        for (key, value) in &self.settings {
            write!(f, "{separator}{key}={value}")?;
            separator = ',';
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn space_around_the_parts_means_nothing_and_settings_are_sorted() {
        let call: Call = " grid : ny = 2 , nx=3, ".parse().unwrap();
        assert_eq!(call.to_string(), "grid:nx=3,ny=2");
        assert_eq!(call, "grid:nx=3,ny=2".parse().unwrap());
        assert_eq!("cotan:".parse::<Call>().unwrap().to_string(), "cotan");
    }

    #[test]
    fn a_setting_without_key_or_value_and_a_key_set_twice_are_refused() {
        for (text, message) in [
            ("grid:nx", "'nx' in 'grid:nx' is not a setting; write key=value"),
            ("grid:=3", "'=3' in 'grid:=3' is not a setting; write key=value"),
            ("grid:nx=", "'nx=' in 'grid:nx=' is not a setting; write key=value"),
            ("grid:nx=1,nx=2", "'nx' is set twice in 'grid:nx=1,nx=2'; leave one of them out"),
        ] {
            assert_eq!(text.parse::<Call>().unwrap_err().to_string(), message);
        }
    }
}
