//! Which group, object or material each face belongs to.

use std::collections::HashMap;

use super::ObjDocument;
use super::text::{Keyword, Statements};

impl ObjDocument {
    /// A number for the names that are in force at each face, of statements that begin with one of `keywords`: `["g"]` for
    /// groups, `["o"]` for objects, `["usemtl"]` for materials. Faces have equal numbers when all those names are equal.
    ///
    /// ```
    /// use qmesh::obj::ObjDocument;
    ///
    /// let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\ng ear\nf 1 2 3\ng\nusemtl skin\nf 1 2 3\n";
    /// let document = ObjDocument::parse(text.into())?;
    /// assert_eq!(document.face_labels(&["g"]), [0, 1, 0]);
    /// assert_eq!(document.face_labels(&["usemtl"]), [0, 0, 1]);
    /// # Ok::<(), qmesh::obj::ObjError>(())
    /// ```
    #[must_use]
    pub fn face_labels(&self, keywords: &[&str]) -> Vec<u32> {
        let text = self.bytes();
        let mut current: Vec<&[u8]> = vec![b""; keywords.len()];
        let mut numbers: HashMap<Vec<&[u8]>, u32> = HashMap::from([(current.clone(), 0)]);
        let mut number = 0;
        let mut labels = Vec::with_capacity(self.face_count());
        for statement in Statements::new(text) {
            match statement.keyword {
                Keyword::Face => labels.push(number),
                Keyword::Other => {
                    let line = text[statement.span].trim_ascii();
                    let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
                    let place = keywords.iter().position(|keyword| keyword.as_bytes() == &line[..end]);
                    if let Some(place) = place {
                        current[place] = line[end..].trim_ascii();
                        let next = numbers.len() as u32;
                        number = *numbers.entry(current.clone()).or_insert(next);
                    }
                }
                _ => {}
            }
        }
        labels
    }

    /// Whether each face belongs to the group, object or material of this name. A face may be in several groups at once (`g a b`).
    ///
    /// ```
    /// use qmesh::obj::ObjDocument;
    ///
    /// let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\ng left ear\nf 1 2 3\ng nose\nusemtl ear\nf 1 2 3\nusemtl skin\nf 1 2 3\n";
    /// let document = ObjDocument::parse(text.into())?;
    /// assert_eq!(document.faces_named(b"ear"), [true, true, false]);
    /// # Ok::<(), qmesh::obj::ObjError>(())
    /// ```
    #[must_use]
    pub fn faces_named(&self, name: &[u8]) -> Vec<bool> {
        let text = self.bytes();
        let mut is_inside = [false; 3];
        let mut named = Vec::with_capacity(self.face_count());
        for statement in Statements::new(text) {
            match statement.keyword {
                Keyword::Face => named.push(is_inside.contains(&true)),
                Keyword::Other => {
                    let line = text[statement.span].trim_ascii();
                    let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
                    let rest = line[end..].trim_ascii();
                    match &line[..end] {
                        b"g" => {
                            let mut names = rest.split(u8::is_ascii_whitespace);
                            is_inside[0] = rest == name || names.any(|group| group == name);
                        }
                        b"o" => is_inside[1] = rest == name,
                        b"usemtl" => is_inside[2] = rest == name,
                        _ => {}
                    }
                }
                _ => {}
            }
        }
        named
    }
}
