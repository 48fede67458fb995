"""State of a unit: rewinding, bytes, two instances at once."""

from bits import bits
from both import FMICallException, Instance


def inputs_of(unit, row):
    return {name: float(row[name]) for name in unit.names("input") if name in row}


def run(instance, rows, step, first=0):
    told = []
    for index, row in enumerate(rows):
        instance.set(**inputs_of(instance.unit, row))
        instance.step((first + index) * step, step)
        told.append({name: bits(float(value)) for name, value in instance.outputs().items()})
    return told


def rewind(unit, rows, start, step):
    """A step back gives the same bits: in memory, from bytes, and in another instance."""
    one = Instance(unit).initialise(**start)
    other = Instance(unit, name="other").initialise(**start)
    half = len(rows) // 2
    begin = run(one, rows[:half], step)
    state = one.save()
    data = one.serialise(state)
    want = run(one, rows[half:], step, half)
    assert want != begin[: len(want)]

    one.restore(state)
    assert run(one, rows[half:], step, half) == want
    one.restore(one.deserialise(data))
    assert run(one, rows[half:], step, half) == want
    # The other instance has not moved yet: the first one's steps were none of its own.
    assert run(other, rows[:half], step) == begin
    other.restore(other.deserialise(data))
    assert run(other, rows[half:], step, half) == want

    # A state goes into an instance that was only made, and brings its phase and parameters with it.
    third = Instance(unit, name="third")
    third.restore(third.deserialise(data))
    assert run(third, rows[half:], step, half) == want

    one.free_state(state)
    damaged = bytearray(data)
    damaged[len(damaged) // 2] ^= 1
    for wrong in (bytes(damaged), data[:-1], b"", b"no state at all, by its first bytes"):
        one.said.clear()
        try:
            one.deserialise(wrong)
        except FMICallException:
            assert one.said and "state" in one.said[-1][1], one.said
        else:
            raise AssertionError("a damaged state was taken")
    one.fmu.reset() if unit.version == 2 else one.fmu.reset()
    assert run(one.initialise(**start), rows[:half], step) == begin
    for instance in (one, other, third):
        instance.close()
    return len(data)
