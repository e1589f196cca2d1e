//! OBJ files, kept as text.
