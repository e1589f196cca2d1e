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
}
