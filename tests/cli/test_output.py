"""Results as people read them on a terminal: every value there, rows in columns, nothing flooded."""

from genmojo_core.cli import output


def shown(capsys, result) -> list[str]:
    output.show(result, as_json=False)
    return capsys.readouterr().out.splitlines()


def test_rows_stand_in_columns_and_long_texts_below_them(capsys) -> None:
    why = "the camera shifts the background by up to 7 px (given)"
    rows = [{"name": "flow", "on": True, "value": 1.23456, "why": why}, {"name": "x", "on": False, "value": 10.0}]
    head, first, below, second = shown(capsys, {"effects": rows})[1:]
    assert head.split() == ["name", "on", "value"]
    assert [first.split(), second.split()] == [["flow", "yes", "1.235"], ["x", "no", "10"]]
    assert head.index("value") == first.index("1.235") == second.index("10")
    assert below.strip() == f"why: {why}"


def test_what_no_row_has_is_no_column_and_zero_is_something(capsys) -> None:
    head, *rows = shown(capsys, {"parts": [{"a": 0, "b": None}, {"a": 1, "b": None}]})[1:]
    assert head.split() == ["a"] and [row.split() for row in rows] == [["0"], ["1"]]


def test_of_many_rows_the_ends_are_shown_and_the_rest_is_counted(capsys) -> None:
    lines = shown(capsys, {"curve": [{"step": i} for i in range(100)]})[2:]
    there = [int(line) for line in lines if line.strip().isdigit()]
    assert there == [*range(12), *range(88, 100)]
    assert "76 more" in lines[12] and len(lines) == 25


def test_sentences_stand_one_to_a_line(capsys) -> None:
    guesses = ["depth is a guess from ground contact", "the camera is taken to stand still"]
    assert [line.strip(" -") for line in shown(capsys, {"guesses": guesses})[1:]] == guesses
    assert shown(capsys, {"size": [480, 270]}) == ["size: 480, 270"]
