"""Messages arrive whole however the bytes are cut; nonsense is refused."""

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.errors import GenmojoError
from genmojo_studio.worker.protocol import MAX_MESSAGE, Decoder, RunRequest, encode

VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-(10**9), 10**9) | st.floats(allow_nan=False) | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=8,
)


@given(
    st.lists(st.dictionaries(st.text(max_size=6), VALUES, max_size=3), max_size=4),
    st.lists(st.integers(1, 40), min_size=1, max_size=6),
)
@settings(max_examples=60, deadline=None)
def test_messages_survive_any_cut(bodies, cuts):
    messages = [{**body, "type": "x"} for body in bodies]
    stream = b"".join(map(encode, messages))
    decoder, found, place, turn = Decoder(), [], 0, 0
    while place < len(stream):
        end = place + cuts[turn % len(cuts)]
        found += decoder.feed(stream[place:end])
        place, turn = end, turn + 1
    assert found == messages


NONSENSE = [b"\xff\xff\xff\xff", (MAX_MESSAGE + 1).to_bytes(4, "big"), b"\0\0\0\2{]", b"\0\0\0\2[]",
            b'\0\0\0\x0a{"type":1}']  # fmt: skip


@pytest.mark.parametrize("data", NONSENSE)
def test_nonsense_is_refused(data):
    with pytest.raises(GenmojoError):
        Decoder().feed(data)


def test_requests_survive_json():
    request = RunRequest(
        "c", "d", "draft", {"seed": 3}, {"flow": False}, (2, None), ("depth",), 1.2, ((0, 1.0, 2.0, 3.0, 4.0),)
    )
    assert RunRequest.from_json(json.loads(json.dumps(request.to_json()))) == request
    with pytest.raises(GenmojoError):
        RunRequest.from_json({"clip": "c", "rm": "-rf"})
    with pytest.raises(GenmojoError):
        RunRequest.from_json({})
