//! Recipes in the words of the RenderMan Shading Language.

use crate::text::pair;
use crate::{Recipe, RecipeError, kind};

/// The parameters that are known.
const NAMES: [&str; 11] = [
    "samples",
    "minsamples",
    "blur",
    "width",
    "swidth",
    "twidth",
    "bias",
    "bias0",
    "bias1",
    "depthfilter",
    "midpointratio",
];

impl Recipe {
    /// A recipe from the parameters of the RenderMan Shading Language's `shadow()`, such as `samples=16, blur=0.01, bias0=0.1, bias1=0.2`, over maps
    /// of `map_size` texels per side.
    ///
    /// | parameter | its translation |
    /// |---|---|
    /// | `samples`, `minsamples` | the fields `samples` and `min-samples` |
    /// | `width`, `swidth`, `twidth` | `res-factor`, 1 unless given; both widths must be equal |
    /// | `blur`, a fraction of the map's side | `min-size`, half of that in texels: the region is at least so large |
    /// | `bias`, or `bias0` and `bias1`, world units | `bias` |
    /// | `depthfilter` `min` or `midpoint`, with `midpointratio` | `reeves87`, or `woo92` with `ratio` |
    ///
    /// ```
    /// use umbrage_recipe::Recipe;
    ///
    /// let recipe = Recipe::from_rsl("samples=32, blur=0.01, bias0=0.1, bias1=0.2", 1000)?;
    /// assert_eq!(recipe.to_string(), "reeves87,samples=32,res-factor=1,min-size=5,bias=0.1..0.2");
    /// # Ok::<(), umbrage_recipe::RecipeError>(())
    /// ```
    ///
    /// # Errors
    /// A parameter that is not known or given twice, an invalid value, and whatever recipes refuse.
    pub fn from_rsl(text: &str, map_size: u32) -> Result<Self, RecipeError> {
        let mut given: Vec<(&str, String)> = Vec::new();
        for part in text.split(',').map(str::trim).filter(|part| !part.is_empty()) {
            let (name, value) = pair(part)?;
            if !NAMES.contains(&name) {
                return Err(RecipeError::value("parameter", name, kind::either(&NAMES)));
            }
            if given.iter().any(|(known, _)| *known == name) {
                return Err(RecipeError::value(name, &value, "one value"));
            }
            given.push((name, value.trim().trim_matches('"').to_owned()));
        }
        let value = |name: &str| given.iter().find(|(known, _)| *known == name).map(|(_, value)| value.as_str());
        let number = |name: &str| -> Result<Option<f64>, RecipeError> {
            let read = |text: &str| {
                let number = text.parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
                number.ok_or_else(|| RecipeError::value(name, text, "a finite number from 0"))
            };
            value(name).map(read).transpose()
        };
        let (preset, ratio) = match value("depthfilter") {
            None | Some("min") => ("reeves87", None),
            Some("midpoint") => ("woo92", number("midpointratio")?),
            Some(other) => return Err(RecipeError::value("depthfilter", other, "min or midpoint")),
        };
        let both = number("width")?.unwrap_or(1.0);
        let (s, t) = (number("swidth")?.unwrap_or(both), number("twidth")?.unwrap_or(both));
        if s != t {
            return Err(RecipeError::value(
                "twidth",
                &t.to_string(),
                format!("{s}, as swidth: regions are not stretched"),
            ));
        }
        let bias = match (number("bias")?, number("bias0")?, number("bias1")?) {
            (None, None, None) => None,
            (Some(bias), None, None) => Some(bias.to_string()),
            (None, low, high) => {
                let (low, high) = (low.or(high).unwrap_or(0.0), high.or(low).unwrap_or(0.0));
                Some(if low == high { low.to_string() } else { format!("{low}..{high}") })
            }
            (Some(bias), ..) => {
                return Err(RecipeError::value("bias", &bias.to_string(), "none beside bias0 and bias1"));
            }
        };
        let blur = number("blur")?.map(|blur| (0.5 * blur * f64::from(map_size)).to_string());
        let fields = [
            ("ratio", ratio.map(|ratio| ratio.to_string())),
            ("samples", value("samples").map(str::to_owned)),
            ("min-samples", value("minsamples").map(str::to_owned)),
            ("res-factor", Some(s.to_string())),
            ("min-size", blur),
            ("bias", bias),
        ];
        let fields = fields.into_iter().filter_map(|(name, value)| value.map(|value| Ok((name, value))));
        Self::with(preset, fields)
    }
}
