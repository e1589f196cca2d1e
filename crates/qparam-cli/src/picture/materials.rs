//! The materials of an OBJ: which one each face has, and what it looks like.
//!
//! `tobj` reads the MTL text. Files are only read where the caller looks them up.

use qoptimize::qmesh::obj::ObjDocument;

use super::color::Linear;

/// What the file says of its materials.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialNames {
    /// The MTL files that are named, in order.
    pub libraries: Vec<String>,
    /// The materials that are used, in order of first use.
    pub names: Vec<String>,
    /// For each face, which of `names` it has; `None` before the first `usemtl`.
    pub of_face: Vec<Option<u32>>,
}

/// What a material looks like.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// `Kd`, as linear light.
    pub color: Linear,
    /// `map_Kd`: the name of an image.
    pub image: Option<String>,
}

impl MaterialNames {
    /// Finds `mtllib` and `usemtl`. A face has the material that was last named above it.
    #[must_use]
    pub fn of(document: &ObjDocument) -> Self {
        let mut found = Self::default();
        // From which line on which material holds.
        let mut changes: Vec<(usize, u32)> = Vec::new();
        for (number, line) in lines(document.bytes()).enumerate() {
            let text = line.trim_ascii_start();
            if let Some(rest) = after_word(text, b"usemtl") {
                let name = String::from_utf8_lossy(rest).into_owned();
                let known = found.names.iter().position(|known| *known == name);
                let material = known.unwrap_or_else(|| {
                    found.names.push(name);
                    found.names.len() - 1
                });
                changes.push((number + 1, material as u32));
            } else if let Some(rest) = after_word(text, b"mtllib") {
                found.libraries.push(String::from_utf8_lossy(rest).into_owned());
            }
        }
        found.of_face = (0..document.face_count())
            .map(|face| {
                let line = document.face_line(face);
                let above = changes.partition_point(|&(change, _)| change < line);
                above.checked_sub(1).map(|last| changes[last].1)
            })
            .collect();
        found
    }
}

/// The looks of a library's materials, by name.
///
/// # Errors
/// What `tobj` could not read, in words.
pub fn read_library(text: &[u8]) -> Result<Vec<(String, Look)>, String> {
    let (materials, _) = tobj::load_mtl_buf(&mut &*text).map_err(|error| error.to_string())?;
    Ok(materials
        .into_iter()
        .map(|material| {
            let [r, g, b] = material.diffuse.unwrap_or([0.8; 3]).map(|x| x.clamp(0.0, 1.0) as f32);
            (material.name, Look { color: Linear([r, g, b]), image: material.diffuse_texture })
        })
        .collect())
}

/// What follows a keyword and a blank, without blanks around it.
fn after_word<'a>(line: &'a [u8], word: &[u8]) -> Option<&'a [u8]> {
    let rest = line.strip_prefix(word)?;
    rest.first()?.is_ascii_whitespace().then(|| rest.trim_ascii())
}

/// Lines that end with LF, CR LF or a lone CR, as the reader of OBJ counts them.
fn lines(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut rest = Some(text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text));
    std::iter::from_fn(move || {
        let text = rest?;
        let Some(end) = text.iter().position(|&byte| byte == b'\n' || byte == b'\r') else {
            rest = None;
            return Some(text);
        };
        let is_pair = text[end..].starts_with(b"\r\n");
        rest = Some(&text[end + 1 + usize::from(is_pair)..]);
        Some(&text[..end])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every face has the material above it, for any line ends; what comes back to a material keeps its number.
    #[test]
    fn faces_have_the_material_above_them() {
        let text = "mtllib a b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red\nf 1 2 3\nf 1 2 \\\n 3\n\
                    usemtl deep blue\nf 1 2 3\n  usemtl red\nf 1 2 3\n#usemtl x\nusemtlx\n";
        for end in ["\n", "\r\n", "\r"] {
            let document = ObjDocument::parse(text.replace('\n', end).into_bytes()).unwrap();
            let found = MaterialNames::of(&document);
            assert_eq!(found.libraries, ["a b.mtl"]);
            assert_eq!(found.names, ["red", "deep blue"]);
            assert_eq!(found.of_face, [None, Some(0), Some(0), Some(1), Some(0)]);
        }
    }

    #[test]
    fn libraries_are_read_by_tobj() {
        let looks =
            read_library(b"newmtl red\nKd 1 0 0\nnewmtl cloth\nKd 1 1 1\nmap_Kd cloth.png\n").unwrap();
        assert_eq!(looks[0], ("red".to_owned(), Look { color: Linear([1.0, 0.0, 0.0]), image: None }));
        assert_eq!(looks[1].1.image.as_deref(), Some("cloth.png"));
        assert!(read_library(b"Kd x y z\n").is_err());
    }
}
