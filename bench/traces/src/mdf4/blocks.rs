//! A block within the file's bounds: nothing behind it is looked at, whatever its counts say.

use mdf4_rs::blocks::{BlockParse, TextBlock};

/// Bytes of a block's header: name, length, number of links.
pub const HEADER: usize = 24;

/// The bytes of a block of one of these kinds, with its kind. The block lies in the file, and its links in the block.
pub fn any<'a>(
    file: &'a [u8],
    address: u64,
    kinds: &[&'static str],
) -> Result<(&'static str, &'a [u8]), String> {
    let broken = || {
        format!(
            "the file is damaged or cut off: no {} block at byte {address}",
            kinds.join(" or ")
        )
    };
    let start = usize::try_from(address).map_err(|_| broken())?;
    let rest = file.get(start..).ok_or_else(broken)?;
    let name = rest.get(..4).ok_or_else(broken)?;
    let kind = kinds
        .iter()
        .find(|kind| kind.as_bytes() == name)
        .ok_or_else(|| {
            let found = String::from_utf8_lossy(name);
            format!(
                "at byte {address} stands {found:?} where {} is expected",
                kinds.join(" or ")
            )
        })?;
    let length = usize::try_from(number(rest, 8).ok_or_else(broken)?).map_err(|_| broken())?;
    let links = number(rest, 16).ok_or_else(broken)?;
    let block = rest.get(..length).ok_or_else(|| {
        format!("the file is cut off: a {kind} block at byte {address} has {length} bytes of which {} are there", rest.len())
    })?;
    let most = block.len().saturating_sub(HEADER) / 8;
    if block.len() < HEADER || links > most as u64 {
        return Err(broken());
    }
    Ok((kind, block))
}

pub fn one<'a>(file: &'a [u8], address: u64, kind: &'static str) -> Result<&'a [u8], String> {
    any(file, address, &[kind]).map(|(_, block)| block)
}

/// A block as the crate reads it.
pub fn parsed<'a, B: BlockParse<'a>>(file: &'a [u8], address: u64) -> Result<B, String> {
    let block = one(file, address, B::ID)?;
    B::from_bytes(block).map_err(|error| format!("the file is damaged at byte {address}: {error}"))
}

pub fn links(block: &[u8]) -> impl Iterator<Item = u64> {
    let count = number(block, 16).unwrap_or(0);
    (0..count).map_while(|link| number(block, HEADER + 8 * usize::try_from(link).ok()?))
}

/// A 64-bit number at a place of a block.
pub fn number(block: &[u8], place: usize) -> Option<u64> {
    let bytes = block.get(place..)?.first_chunk::<8>()?;
    Some(u64::from_le_bytes(*bytes))
}

/// A text; empty where there is none. Of metadata in XML, its text.
pub fn text(file: &[u8], address: u64) -> Result<String, String> {
    if address == 0 {
        return Ok(String::new());
    }
    let (kind, block) = any(file, address, &["##TX", "##MD"])?;
    if kind == "##TX" {
        let text = TextBlock::from_bytes(block).map_err(|error| error.to_string())?;
        return Ok(text.text.trim().to_string());
    }
    let xml = String::from_utf8_lossy(block.get(HEADER..).unwrap_or_default()).into_owned();
    let inside = xml
        .split_once("<TX")
        .and_then(|(_, rest)| rest.split_once('>'))
        .and_then(|(_, rest)| rest.split_once("</TX>"));
    Ok(inside.map_or("", |(text, _)| text).trim().to_string())
}
