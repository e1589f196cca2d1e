//! Which pieces the new text is made of: old text, and new `vt` lines in their place.

use std::ops::Range;

use rayon::prelude::*;

use super::chunks::chunks;
use super::text::{Keyword, Statement, Statements, Tokens, is_left_open};

/// How many vertices' values make a piece.
const VERTICES_AT_ONCE: usize = 1 << 14;

/// What becomes a piece of the new text.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Job {
    /// Bytes of the old one, and its first face.
    Text(Range<usize>, usize),
    /// New `vt` lines, those of some vertices.
    Values(Range<usize>),
    /// The same after the last line, when that lacks its line end: then so does the new last line.
    ValuesAfter(Range<usize>),
    /// What makes the last line end, which was to be continued.
    Close,
}

/// What to do with old `vt` lines, and where the new ones go.
pub(super) struct Plan {
    pub(super) keeps_old: bool,
    pub(super) jobs: Vec<Job>,
}

/// What a chunk has to say about that.
#[derive(Default)]
struct Facts {
    faces: usize,
    has_old: bool,
    is_referenced: bool,
    /// The first `vt` or face.
    first_place: Option<usize>,
    /// After the last line before which nothing may come, and how many faces of the chunk come before it.
    last_needed: Option<(usize, usize)>,
}

impl Facts {
    fn new(text: &[u8], chunk: Range<usize>) -> Self {
        let mut facts = Self::default();
        for statement in Statements::within(text, chunk) {
            match statement.keyword {
                Keyword::Texture => {
                    facts.first_place.get_or_insert(statement.span.start);
                    facts.last_needed = Some((statement.span.end, facts.faces));
                    facts.has_old = true;
                }
                Keyword::Face => {
                    facts.first_place.get_or_insert(statement.span.start);
                    facts.faces += 1;
                }
                Keyword::Reference => {
                    let named = texture_reference(text, &statement);
                    facts.is_referenced |= named.is_some();
                    // A negative index counts from where it stands: nothing may come between.
                    if named == Some(Sign::Negative) {
                        facts.last_needed = Some((statement.span.end, facts.faces));
                    }
                }
                Keyword::Vertex | Keyword::Numbers | Keyword::Other => {}
            }
        }
        facts
    }
}

impl Plan {
    pub(super) fn new(text: &[u8], chunk: usize, vertices: usize) -> Self {
        let chunks = chunks(text, chunk);
        let facts: Vec<Facts> = chunks.par_iter().map(|chunk| Facts::new(text, chunk.clone())).collect();
        let keeps_old =
            facts.iter().any(|facts| facts.has_old) && facts.iter().any(|facts| facts.is_referenced);
        let mut texts = Vec::with_capacity(chunks.len() + 1);
        let (mut first_place, mut last_needed, mut faces) = (None, None, 0);
        for (chunk, facts) in chunks.into_iter().zip(facts) {
            first_place = first_place.or(facts.first_place.map(|place| (place, faces)));
            last_needed = facts.last_needed.map(|(place, before)| (place, faces + before)).or(last_needed);
            texts.push(Job::Text(chunk, faces));
            faces += facts.faces;
        }
        let (insert_at, faces_before) =
            if keeps_old { last_needed } else { first_place }.unwrap_or((text.len(), faces));
        let mut jobs = Vec::with_capacity(texts.len() + vertices / VERTICES_AT_ONCE + 3);
        if insert_at == text.len() {
            jobs.extend(texts);
            jobs.extend(values_at_end(text, vertices));
            return Self { keeps_old, jobs };
        }
        for job in texts {
            match job {
                Job::Text(range, first_face) if range.contains(&insert_at) => {
                    jobs.push(Job::Text(range.start..insert_at, first_face));
                    jobs.extend(vertex_ranges(vertices).map(Job::Values));
                    jobs.push(Job::Text(insert_at..range.end, faces_before));
                }
                other => jobs.push(other),
            }
        }
        Self { keeps_old, jobs }
    }
}

fn vertex_ranges(vertices: usize) -> impl Iterator<Item = Range<usize>> {
    (0..vertices).step_by(VERTICES_AT_ONCE).map(move |start| start..vertices.min(start + VERTICES_AT_ONCE))
}

fn values_at_end(text: &[u8], vertices: usize) -> Vec<Job> {
    let is_ended = matches!(text.last(), Some(b'\n' | b'\r'));
    let close = is_left_open(text).then_some(Job::Close);
    let values = if is_ended { Job::Values } else { Job::ValuesAfter };
    close.into_iter().chain(vertex_ranges(vertices).map(values)).collect()
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sign {
    Positive,
    Negative,
}

/// Whether a line or surface names texture coordinates, and whether any of them counts backwards.
fn texture_reference(text: &[u8], statement: &Statement) -> Option<Sign> {
    let mut found = None;
    for token in Tokens::new(text, &statement.body) {
        let middle = text[token].split(|&b| b == b'/').nth(1).unwrap_or_default();
        match middle.first() {
            None => {}
            Some(b'-') => return Some(Sign::Negative),
            Some(_) => found = Some(Sign::Positive),
        }
    }
    found
}
