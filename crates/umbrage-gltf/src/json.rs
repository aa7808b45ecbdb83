//! A value of the JSON that knows its path, so that every fault names the field.

use crate::GltfError;
use crate::error::quoted;
use serde_json::Value;

/// A value and where it stands.
#[derive(Clone, Debug)]
pub(crate) struct At<'a> {
    /// The value.
    pub value: &'a Value,
    /// Its path from the root, such as `nodes[3].mesh`.
    pub path: String,
}

impl<'a> At<'a> {
    /// The whole document.
    pub fn root(value: &'a Value) -> Self {
        Self { value, path: String::new() }
    }

    /// The path of a member.
    pub fn path_of(&self, name: &str) -> String {
        if self.path.is_empty() { name.to_owned() } else { format!("{}.{name}", self.path) }
    }

    /// A member, where there is one.
    pub fn get(&self, name: &str) -> Option<Self> {
        let value = self.value.get(name)?;
        Some(Self { value, path: self.path_of(name) })
    }

    /// A member of an array, whose number must exist.
    pub fn item(&self, index: usize) -> Result<Self, GltfError> {
        let path = format!("{}[{index}]", self.path);
        match self.value.get(index) {
            Some(value) => Ok(Self { value, path }),
            None => Err(GltfError::field(path, "nothing", "a value")),
        }
    }

    /// The members of an array; none where the array is absent.
    pub fn items(&self, name: &str) -> Result<Vec<Self>, GltfError> {
        let values = self.list(name)?.iter().enumerate();
        let path = self.path_of(name);
        Ok(values.map(|(index, value)| Self { value, path: format!("{path}[{index}]") }).collect())
    }

    /// The values of an array; none where the array is absent.
    pub fn list(&self, name: &str) -> Result<&'a [Value], GltfError> {
        match self.value.get(name) {
            None => Ok(&[]),
            Some(Value::Array(values)) => Ok(values),
            Some(_) => Err(self.wrong(name, "an array")),
        }
    }

    /// What an extension says here.
    pub fn extension(&self, name: &str) -> Option<Self> {
        self.get("extensions")?.get(name)
    }

    /// A member whose value is not what was expected.
    pub fn wrong(&self, name: &str, expected: impl std::fmt::Display) -> GltfError {
        let value = self.value.get(name).map_or_else(|| "nothing".into(), describe);
        GltfError::field(self.path_of(name), value, expected)
    }

    /// A number; JSON knows no NaN and no infinity.
    pub fn number(&self, name: &str) -> Result<Option<f64>, GltfError> {
        let Some(value) = self.value.get(name) else { return Ok(None) };
        value.as_f64().map(Some).ok_or_else(|| self.wrong(name, "a number"))
    }

    /// A number within a range, or a default.
    pub fn number_in(
        &self,
        name: &str,
        default: f64,
        fits: impl Fn(f64) -> bool,
        expected: &str,
    ) -> Result<f64, GltfError> {
        let number = self.number(name)?.unwrap_or(default);
        if fits(number) { Ok(number) } else { Err(self.wrong(name, expected)) }
    }

    /// As many numbers as are wanted.
    pub fn numbers<const N: usize>(&self, name: &str) -> Result<Option<[f64; N]>, GltfError> {
        let Some(value) = self.value.get(name) else { return Ok(None) };
        let expected = || format!("{N} numbers");
        let values = value.as_array().filter(|values| values.len() == N);
        let values = values.ok_or_else(|| self.wrong(name, expected()))?;
        let mut numbers = [0.0; N];
        for (number, value) in numbers.iter_mut().zip(values) {
            *number =
                value.as_f64().ok_or_else(|| GltfError::field(self.path_of(name), describe(value), expected()))?;
        }
        Ok(Some(numbers))
    }

    /// A whole number from 0, also where it is written as 5.0.
    pub fn whole(&self, name: &str) -> Result<Option<u64>, GltfError> {
        let Some(value) = self.value.get(name) else { return Ok(None) };
        whole(value).map(Some).ok_or_else(|| self.wrong(name, "a whole number from 0"))
    }

    /// A whole number from 0 that counts what memory holds; `default` where it is absent.
    pub fn size(&self, name: &str, default: usize) -> Result<usize, GltfError> {
        match self.whole(name)? {
            None => Ok(default),
            Some(size) => usize::try_from(size).map_err(|_| self.wrong(name, "a size that fits in memory")),
        }
    }

    /// The number of one of `count` things.
    pub fn index(&self, name: &str, count: usize, of: &str) -> Result<Option<usize>, GltfError> {
        let Some(value) = self.value.get(name) else { return Ok(None) };
        index(value, count).map(Some).ok_or_else(|| self.wrong(name, of_count(count, of)))
    }

    /// The numbers of some of `count` things.
    pub fn indices(&self, name: &str, count: usize, of: &str) -> Result<Vec<usize>, GltfError> {
        let values = self.list(name)?.iter().enumerate();
        let wrong = |at: usize, value| {
            GltfError::field(format!("{}[{at}]", self.path_of(name)), describe(value), of_count(count, of))
        };
        values.map(|(at, value)| index(value, count).ok_or_else(|| wrong(at, value))).collect()
    }

    /// A text.
    pub fn text(&self, name: &str) -> Result<Option<&'a str>, GltfError> {
        let Some(value) = self.value.get(name) else { return Ok(None) };
        value.as_str().map(Some).ok_or_else(|| self.wrong(name, "a text"))
    }

    /// True or false.
    pub fn flag(&self, name: &str, default: bool) -> Result<bool, GltfError> {
        let Some(value) = self.value.get(name) else { return Ok(default) };
        value.as_bool().ok_or_else(|| self.wrong(name, "true or false"))
    }

    /// A name that is not empty.
    pub fn name(&self) -> Option<&'a str> {
        self.value.get("name").and_then(Value::as_str).filter(|name| !name.is_empty())
    }
}

fn of_count(count: usize, of: &str) -> String {
    format!("the number of one of {count} {of}")
}

fn whole(value: &Value) -> Option<u64> {
    // The largest f64 that every whole number below has of its own.
    const MOST: f64 = 9_007_199_254_740_992.0;
    let rounded = || value.as_f64().filter(|number| number.fract() == 0.0 && (0.0..=MOST).contains(number));
    value.as_u64().or_else(|| rounded().map(|number| number as u64))
}

fn index(value: &Value, count: usize) -> Option<usize> {
    whole(value).and_then(|index| usize::try_from(index).ok()).filter(|&index| index < count)
}

/// A value in few words.
fn describe(value: &Value) -> String {
    match value {
        Value::Array(values) => format!("an array of {}", values.len()),
        Value::Object(members) => format!("an object of {}", members.len()),
        Value::String(text) => quoted(text),
        other => other.to_string(),
    }
}
