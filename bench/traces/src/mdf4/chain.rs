//! The bytes of a data group: one block or a list of them, plain or compressed.

use std::collections::HashSet;

use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;

use super::blocks::{HEADER, any, links, number};

/// Largest block after decompression, bytes; the standard recommends 4 MiB.
const LARGEST_BLOCK: u64 = 1 << 28;
/// Most bytes of a data group, however often its lists name a block.
const LARGEST_GROUP: u64 = 1 << 32;

/// Gives every data block of a data group to `visit`, in order, until it wants no more.
pub fn visit(
    file: &[u8],
    address: u64,
    visit: &mut dyn FnMut(&[u8]) -> Result<bool, String>,
) -> Result<(), String> {
    let mut left = LARGEST_GROUP;
    let mut seen = HashSet::new();
    let mut next = address;
    while next != 0 {
        if !seen.insert(next) {
            return Err(format!(
                "the file is damaged: its data lists go in a circle at byte {next}"
            ));
        }
        let (kind, block) = any(
            file,
            next,
            &["##DT", "##DZ", "##DL", "##HL", "##DV", "##LD"],
        )?;
        let mut following = links(block);
        match kind {
            "##DT" | "##DZ" => {
                leaf(kind, block, &mut left, visit)?;
                return Ok(());
            }
            "##HL" => next = following.next().unwrap_or(0),
            "##DL" => {
                next = following.next().unwrap_or(0);
                for fragment in following.filter(|fragment| *fragment != 0) {
                    let (kind, block) = any(file, fragment, &["##DT", "##DZ"])?;
                    if !leaf(kind, block, &mut left, visit)? {
                        return Ok(());
                    }
                }
            }
            _ => {
                return Err("the data stand in columns (MDF 4.2), which are not read; save the file in rows, as MDF 4.1 has them".into());
            }
        }
    }
    Ok(())
}

/// One data block; whether more are wanted.
fn leaf(
    kind: &str,
    block: &[u8],
    left: &mut u64,
    visit: &mut dyn FnMut(&[u8]) -> Result<bool, String>,
) -> Result<bool, String> {
    let inflated;
    let data = if kind == "##DZ" {
        inflated = inflate(block)?;
        &inflated
    } else {
        block.get(HEADER..).unwrap_or_default()
    };
    *left = left
        .checked_sub(data.len() as u64)
        .ok_or("the data of a group are longer than 4 GiB")?;
    visit(data)
}

fn inflate(block: &[u8]) -> Result<Vec<u8>, String> {
    let broken = || "the file is damaged: a compressed block does not inflate".to_string();
    let head = block.get(HEADER..HEADER + 8).ok_or_else(broken)?;
    let (original, packed) = (
        number(block, 32).ok_or_else(broken)?,
        number(block, 40).ok_or_else(broken)?,
    );
    let [b'D', b'T', way, _, columns @ ..] = head else {
        return Err("a compressed block holds no records".into());
    };
    if *way > 1 {
        return Err(format!(
            "a compressed block is packed in way {way}; read are 0 (deflate) and 1 (transposed)"
        ));
    }
    if original > LARGEST_BLOCK {
        return Err(format!(
            "a compressed block says that it has {original} bytes: at most {LARGEST_BLOCK}"
        ));
    }
    let packed = usize::try_from(packed)
        .ok()
        .and_then(|length| block.get(48..)?.get(..length));
    let limit = usize::try_from(original).map_err(|_| broken())?;
    let data = decompress_to_vec_zlib_with_limit(packed.ok_or_else(broken)?, limit)
        .map_err(|_| broken())?;
    if data.len() != limit {
        return Err(broken());
    }
    let columns = columns
        .iter()
        .rev()
        .fold(0usize, |sum, byte| sum << 8 | usize::from(*byte));
    Ok(if *way == 1 {
        rows(&data, columns)
    } else {
        data
    })
}

/// Bytes that stand column by column, row by row again; what fills no row stands behind, as it was.
fn rows(data: &[u8], columns: usize) -> Vec<u8> {
    let rows = data.len().checked_div(columns).unwrap_or(0);
    if rows < 2 || columns < 2 {
        return data.to_vec();
    }
    let (whole, rest) = data.split_at(rows * columns);
    let mut out = vec![0; data.len()];
    for (column, bytes) in whole.chunks_exact(rows).enumerate() {
        for (slot, byte) in out.iter_mut().skip(column).step_by(columns).zip(bytes) {
            *slot = *byte;
        }
    }
    if let Some(slot) = out.get_mut(rows * columns..) {
        slot.copy_from_slice(rest);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_become_rows_and_a_rest_stays() {
        assert_eq!(rows(&[1, 4, 2, 5, 3, 6, 7], 3), [1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(rows(&[1, 2, 3], 0), [1, 2, 3]);
        assert_eq!(rows(&[1, 2, 3], 5), [1, 2, 3]);
    }
}
