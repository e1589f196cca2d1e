//! Names in an OBJ file: objects, groups, materials, material libraries.

use std::collections::HashSet;

use serde::Serialize;

/// Names in the order of their first appearance.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Labels {
    pub(crate) objects: Vec<String>,
    pub(crate) groups: Vec<String>,
    pub(crate) materials: Vec<String>,
    pub(crate) material_libraries: Vec<String>,
}

impl Labels {
    pub(crate) fn new(bytes: &[u8]) -> Self {
        let mut labels = Self::default();
        let mut seen = HashSet::new();
        for line in bytes.split(|&byte| byte == b'\n' || byte == b'\r') {
            let line = line.trim_ascii_start();
            // Most lines are `v` and `f`: they leave here.
            if !matches!(line.first(), Some(b'o' | b'g' | b'u' | b'm')) {
                continue;
            }
            let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
            let name = String::from_utf8_lossy(&line[end..]).trim().to_owned();
            let names = match &line[..end] {
                b"o" => &mut labels.objects,
                b"g" => &mut labels.groups,
                b"usemtl" => &mut labels.materials,
                b"mtllib" => &mut labels.material_libraries,
                _ => continue,
            };
            if !name.is_empty() && seen.insert(line) {
                names.push(name);
            }
        }
        labels
    }

    /// The lists that are not empty, shortened for people.
    pub(crate) fn lists(&self) -> impl Iterator<Item = (&'static str, String)> + '_ {
        const SHOWN: usize = 6;
        let lists = [
            ("objects", &self.objects),
            ("groups", &self.groups),
            ("materials", &self.materials),
            ("mtllib", &self.material_libraries),
        ];
        lists.into_iter().filter(|(_, names)| !names.is_empty()).map(|(label, names)| {
            let mut text = names.iter().take(SHOWN).map(String::as_str).collect::<Vec<_>>().join(", ");
            if names.len() > SHOWN {
                text += &format!(", … ({} in all)", names.len());
            }
            (label, text)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Labels;

    #[test]
    fn names_are_listed_once() {
        let text =
            b"mtllib a.mtl\r\no Head\ng eyes\nusemtl skin\nf 1 2 3\ng eyes\ngarbage x\nusemtl k\xe4se\ng\n";
        let labels = Labels::new(text);
        let shown: Vec<_> = labels.lists().map(|(label, names)| format!("{label}={names}")).collect();
        assert_eq!(shown, ["objects=Head", "groups=eyes", "materials=skin, k\u{fffd}se", "mtllib=a.mtl"]);
    }
}
