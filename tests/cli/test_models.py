"""External models through the command line: reachable, and wrong combinations are one sentence."""

import numpy as np
import pytest

from genmojo_core.cli.main import main


def run(capsys: pytest.CaptureFixture[str], clip: str, *options: str) -> tuple[int, str]:
    code = main(["effects", clip, "--preset", "draft", "--json", *options])
    return code, capsys.readouterr().err.strip()


def test_depth_of_another_program_takes_the_place_of_the_guess(tmp_path, capsys) -> None:
    from clip_files import make_clip

    clip = make_clip(tmp_path / "clip", frames=3)
    depth = 2.0 + np.random.default_rng(0).random((3, 24, 32)).astype(np.float32)
    np.savez(tmp_path / "depth.npz", depth=depth)
    code = main(["effects", str(clip), "--depth-file", f"metric:{tmp_path / 'depth.npz'}", "--json"])
    shown = capsys.readouterr().out
    assert code == 0
    assert "depth is a guess" not in shown.lower()


@pytest.mark.parametrize(
    "options",
    [
        ("--depth-model", "nowhere", "--depth-file", "a.npz"),
        ("--detector", "nowhere"),
        ("--find", "a red cup"),
        ("--depth-model", "nowhere"),
        ("--mask-model", "nowhere"),
        ("--detector", "nowhere", "--find", "a cup"),
        ("--depth-file", "nowhere.npz"),
    ],
)
def test_what_cannot_be_is_one_sentence(tmp_path, capsys, options: tuple[str, ...]) -> None:
    from clip_files import make_clip

    code, said = run(capsys, str(make_clip(tmp_path / "clip", frames=2)), *options)
    assert code == 2
    assert said.splitlines()[-1].endswith(".")
    assert "Traceback" not in said
