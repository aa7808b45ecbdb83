use std::path::Path;

/// Why a file could not be read or written. Always one line: the file, the field and what it holds.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum IoError {
    /// The system refused.
    #[error("{file}: cannot {action}: {source}")]
    System {
        /// The file.
        file: String,
        /// What was tried.
        action: &'static str,
        /// The system's answer.
        source: std::io::Error,
    },
    /// The file, or what was to be written to it, is not as it must be.
    #[error("{file}: {fault}")]
    Content {
        /// The file.
        file: String,
        /// What is wrong with it.
        fault: Fault,
    },
}

/// A field that does not hold what it must.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{field} is {value}: {problem}")]
pub struct Fault {
    /// What the field is called in the file.
    pub field: String,
    /// What it holds, made fit to print on one line.
    pub value: String,
    /// Why that will not do.
    pub problem: String,
}

impl Fault {
    /// `value` and `problem` may come from the file: control characters are escaped and long text is cut.
    #[expect(clippy::needless_pass_by_value, reason = "callers hand over what they have just made")]
    pub(crate) fn new(field: impl ToString, value: impl ToString, problem: impl ToString) -> Self {
        let one_line = |text: &str| text.escape_debug().take(120).collect::<String>();
        Self {
            field: one_line(&field.to_string()),
            value: one_line(&value.to_string()),
            problem: one_line(&problem.to_string()),
        }
    }

    /// The same of one of several parts.
    pub(crate) fn in_part(self, part: &str) -> Self {
        let part: String = part.escape_debug().take(120).collect();
        Self { field: format!("part {part}: {}", self.field), ..self }
    }

    pub(crate) fn in_file(self, path: &Path) -> IoError {
        IoError::Content { file: name(path), fault: self }
    }
}

/// How a path is printed: on one line.
pub(crate) fn name(path: &Path) -> String {
    path.display().to_string().escape_debug().collect()
}

pub(crate) fn system(path: &Path, action: &'static str) -> impl FnOnce(std::io::Error) -> IoError {
    let file = name(path);
    move |source| IoError::System { file, action, source }
}
