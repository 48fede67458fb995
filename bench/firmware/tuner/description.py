"""Compares every address, size and type of an A2L file with the image that it describes.

The file is read by pya2l, the image by pyelftools: its symbol table says where a variable stands and how large it is, its debug
information what is in it. Neither is the program that wrote the file.

    python description.py IMAGE FILE
"""

import sys

from elftools.dwarf.descriptions import describe_form_class
from elftools.elf.elffile import ELFFile
from pya2l import import_a2l, model

TYPES = {("DW_ATE_float", 4): "FLOAT32_IEEE", ("DW_ATE_unsigned", 4): "ULONG"}
ENCODINGS = {4: "DW_ATE_float", 7: "DW_ATE_unsigned"}


def read_a2l(path):
    """The numbers of the file by name: address, type, symbol, lower and upper limit, unit; and its memory segments."""
    session = import_a2l(
        path, in_memory=True, progress_bar=False, loglevel="ERROR", local=True
    )
    layouts = {
        layout.name: layout.fnc_values.datatype
        for layout in session.query(model.RecordLayout)
    }
    units = {method.name: method.unit for method in session.query(model.CompuMethod)}
    numbers = {}
    for number in session.query(model.Characteristic):
        numbers[number.name] = (
            number.address,
            layouts[number.deposit],
            number.symbol_link.symbolName,
            (number.lowerLimit, number.upperLimit),
            units[number.conversion],
        )
    for number in session.query(model.Measurement):
        numbers[number.name] = (
            number.ecu_address.address,
            number.datatype,
            number.symbol_link.symbolName,
            (number.lowerLimit, number.upperLimit),
            units[number.conversion],
        )
    segments = {
        segment.name: (segment.address, segment.size)
        for segment in session.query(model.MemorySegment)
    }
    return numbers, segments


def symbols(image):
    """Address and size of every variable, by its name in the symbol table."""
    table = image.get_section_by_name(".symtab")
    return {
        symbol.name: (symbol["st_value"], symbol["st_size"])
        for symbol in table.iter_symbols()
        if symbol["st_info"]["type"] == "STT_OBJECT"
    }


def members(kind, path, offset):
    """Offset and type of every number in a type, by its path."""
    kind_name = kind.attributes.get("DW_AT_encoding")
    if kind.tag == "DW_TAG_base_type":
        size = kind.attributes["DW_AT_byte_size"].value
        yield path, offset, TYPES[(ENCODINGS[kind_name.value], size)]
        return
    for child in kind.iter_children():
        if child.tag == "DW_TAG_member":
            place = child.attributes["DW_AT_data_member_location"]
            assert describe_form_class(place.form) == "constant"
            name = child.attributes["DW_AT_name"].value.decode()
            inner = child.get_DIE_from_attribute("DW_AT_type")
            yield from members(inner, f"{path}.{name}", offset + place.value)


def numbers_of(image, names):
    """Address and type of every number of these variables, by its path."""
    addresses = symbols(image)
    found = {}
    for unit in image.get_dwarf_info(relocate_dwarf_sections=False).iter_CUs():
        for entry in unit.get_top_DIE().iter_children():
            stack = [entry]
            while stack:
                entry = stack.pop()
                if entry.tag == "DW_TAG_namespace":
                    stack.extend(entry.iter_children())
                name = entry.attributes.get("DW_AT_name")
                if entry.tag != "DW_TAG_variable" or name is None:
                    continue
                name = name.value.decode()
                if name in names and "DW_AT_location" in entry.attributes:
                    kind = entry.get_DIE_from_attribute("DW_AT_type")
                    for path, offset, number in members(kind, name, 0):
                        found[path] = (addresses[name][0] + offset, number)
    return found


def main(image_path, a2l_path):
    numbers, segments = read_a2l(a2l_path)
    with open(image_path, "rb") as file:
        image = ELFFile(file)
        assert image.little_endian and image.elfclass == 32
        known = symbols(image)
        found = numbers_of(image, {"REFERENCE_PAGE", "WORKING_PAGE", "MEASURED"})
    described = {}
    for name, (address, kind, symbol, _, _) in numbers.items():
        assert symbol in found, f"{name}: the image has no {symbol}"
        assert (address, kind) == found[symbol], (
            f"{name}: {address:#x} {kind} in the file, "
            f"{found[symbol][0]:#x} {found[symbol][1]} in the image"
        )
        described[symbol] = name
    missing = found.keys() - described.keys()
    assert not missing, f"not described: {sorted(missing)}"
    for segment, symbol in (
        ("working_page", "WORKING_PAGE"),
        ("reference_page", "REFERENCE_PAGE"),
    ):
        assert segments[segment] == known[symbol], f"{segment}: {segments[segment]}"
    print(f"{len(numbers)} addresses and types, 2 memory segments: as in the image")


if __name__ == "__main__":
    main(*sys.argv[1:])
