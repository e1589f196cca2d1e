//! A second opinion on what UVs are in OBJ text: slow, byte by byte, sharing no code with the crate.

/// The text without `vt` lines and without middle indices; what is left must never change.
pub(crate) fn without_uv(text: &[u8]) -> Vec<u8> {
    let mut left = Vec::new();
    for statement in statements(text) {
        match keyword(&statement) {
            b"vt" => {}
            b"f" | b"fo" => left.extend(without_middle_indices(&statement)),
            _ => left.extend(statement),
        }
    }
    left
}

/// The line numbers, from 1, of statements with one of these keywords.
pub(crate) fn lines_of(text: &[u8], keywords: &[&[u8]]) -> Vec<usize> {
    let mut line = 1;
    let mut found = Vec::new();
    for statement in statements(text) {
        if keywords.contains(&keyword(&statement)) {
            found.push(line);
        }
        line += physical_lines(&statement).len();
    }
    found
}

/// Lines with their ends, put together where numbers are continued.
fn statements(text: &[u8]) -> Vec<Vec<u8>> {
    const NUMBERS: [&[u8]; 12] =
        [b"v", b"vt", b"vn", b"vp", b"f", b"fo", b"l", b"p", b"surf", b"curv", b"curv2", b"parm"];
    let mut statements: Vec<Vec<u8>> = Vec::new();
    let mut goes_on = false;
    for line in physical_lines(text) {
        let bare: &[u8] = match &line[..] {
            [bare @ .., b'\r', b'\n'] | [bare @ .., b'\r' | b'\n'] => bare,
            bare => bare,
        };
        let is_continued = bare.last() == Some(&b'\\') && bare.len() < line.len() && !bare.contains(&b'#');
        match statements.last_mut() {
            Some(statement) if goes_on => statement.extend(&line),
            _ => statements.push(line.clone()),
        }
        let started = statements.last().map(|statement| keyword(statement).to_vec()).unwrap_or_default();
        goes_on = is_continued && NUMBERS.contains(&&started[..]);
    }
    statements
}

fn physical_lines(text: &[u8]) -> Vec<Vec<u8>> {
    let mut lines = vec![Vec::new()];
    for (i, &byte) in text.iter().enumerate() {
        lines.last_mut().expect("never empty").push(byte);
        if byte == b'\n' || (byte == b'\r' && text.get(i + 1) != Some(&b'\n')) {
            lines.push(Vec::new());
        }
    }
    lines.retain(|line| !line.is_empty());
    lines
}

fn keyword(statement: &[u8]) -> &[u8] {
    let statement = statement.strip_prefix(b"\xef\xbb\xbf").unwrap_or(statement);
    let mut words = statement.split(|b| b" \t\r\n\x0b\x0c\\".contains(b));
    words.find(|word| !word.is_empty()).unwrap_or_default()
}

fn without_middle_indices(statement: &[u8]) -> Vec<u8> {
    let mut left = Vec::new();
    let mut slashes = 0;
    for (i, &byte) in statement.iter().enumerate() {
        match byte {
            b'#' => {
                left.extend(&statement[i..]);
                break;
            }
            b' ' | b'\t' | b'\r' | b'\n' | b'\\' | b'\x0b' | b'\x0c' => {
                slashes = 0;
                left.push(byte);
            }
            // `1/` and `1` say the same, so a first slash counts only with a second.
            b'/' => {
                slashes += 1;
                left.extend(if slashes == 2 { &b"//"[..] } else { b"" });
            }
            _ if slashes == 1 => {}
            _ => left.push(byte),
        }
    }
    left
}

#[test]
fn the_second_opinion_itself() {
    let text = b"v 1 2 3 # 1/1\nvt 0 \\\n 0\r\n  f 1/2 2/ 3//4 \\\n 5/6/7#8/9\nl 1/1 2/2\rvtx\n";
    let left = b"v 1 2 3 # 1/1\n  f 1 2 3//4 \\\n 5//7#8/9\nl 1/1 2/2\rvtx\n";
    assert_eq!(without_uv(text), left);
    assert_eq!(lines_of(text, &[b"f", b"v"]), [1, 4]);
}
