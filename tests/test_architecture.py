"""The house rules that a machine can check: sizes, annotations, docstrings, banned calls, layers, import weight.

Each rule is a function from a parsed file to a list of faults; `BAD` holds a snippet that each rule must catch.
Not covered: whether a docstring is true, and calls reached through getattr.
"""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
MAX_FILE_LINES, MAX_FUNCTION_LINES, MAX_PARAMETERS = 400, 50, 8

# The only files that may open untrusted pickles or checkpoints: they run in child processes of their own.
CHILD_PROCESSES = {"genmojo_core/trackers/cotracker_process.py", "genmojo_core/store/tapvid_pickle_process.py",
                   "genmojo_core/priors/bin_weights_process.py"}  # fmt: skip
# The only files that may catch everything: they are the outermost frame of a process.
PROCESS_BOUNDARIES = {"genmojo_core/cli/main.py"}
# Where gradients flow: maths that gives infinite or undefined gradients is written once, in safemath.py.
GRADIENT_PACKAGES = ("genmojo_core/scene/", "genmojo_core/optimise/", "genmojo_core/priors/")
SAFEMATH = "genmojo_core/scene/safemath.py"
UNSAFE_GRADIENTS = {"log", "log2", "log10", "acos", "arccos", "asin", "arcsin", "logit", "atanh", "arctanh", "sqrt",
                    "rsqrt", "normalize", "reciprocal", "quantile"}  # fmt: skip
PLAIN_MATHS = {"math", "np", "numpy", "cmath", "cv2", "safemath"}  # modules whose functions carry no gradient

BANNED_IMPORTS = {"pickle", "cPickle", "_pickle", "cloudpickle", "dill", "joblib", "shelve", "marshal"}
BANNED_CALLS = {"torch.load", "torch.hub.load", "yaml.load", "yaml.unsafe_load", "os.system", "os.popen",
                "subprocess.getoutput", "pandas.read_pickle", "torch.hub.load_state_dict_from_url"}  # fmt: skip
BANNED_NAMES = {"eval", "exec", "print", "breakpoint", "input"}

Rule = Callable[[str, ast.Module, str], list[str]]
Function = ast.FunctionDef | ast.AsyncFunctionDef


def sources(*folders: str) -> list[Path]:
    """Python files of some folders of the project."""
    return sorted(p for folder in folders for p in (ROOT / folder).rglob("*.py") if "__pycache__" not in p.parts)


def functions(tree: ast.Module) -> Iterator[Function]:
    """Every function and method, nested ones too."""
    return (node for node in ast.walk(tree) if isinstance(node, Function))


def dotted(node: ast.expr, aliases: dict[str, str]) -> str:
    """Full name of a called thing, e.g. "torch.load" for `t.load` after `import torch as t`; "" where unknown."""
    if isinstance(node, ast.Name):
        return aliases.get(node.id, node.id)
    if isinstance(node, ast.Attribute):
        base = dotted(node.value, aliases)
        return f"{base}.{node.attr}" if base else ""
    return ""


def import_aliases(tree: ast.Module) -> dict[str, str]:
    """What each imported name stands for."""
    names: dict[str, str] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {a.asname: a.name for a in node.names if a.asname}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {a.asname or a.name: f"{node.module}.{a.name}" for a in node.names}
    return names


# ---- rules ----------------------------------------------------------------------------------------------------------


def sizes(path: str, tree: ast.Module, text: str) -> list[str]:
    """Files and functions stay short enough to read in one go; the docstring counts, decorators do not."""
    lines = text.count("\n")
    faults = [f"{path}: {lines} lines, allowed {MAX_FILE_LINES}"] if lines > MAX_FILE_LINES else []
    for node in functions(tree):
        length = (node.end_lineno or node.lineno) - node.lineno + 1
        if length > MAX_FUNCTION_LINES:
            faults.append(f"{path}:{node.lineno} {node.name}: {length} lines, allowed {MAX_FUNCTION_LINES}")
    return faults


def annotations(path: str, tree: ast.Module, text: str) -> list[str]:
    """Every argument of every function is annotated."""
    faults = []
    for node in functions(tree):
        a = node.args
        every = [*a.posonlyargs, *a.args, *a.kwonlyargs, *(x for x in (a.vararg, a.kwarg) if x)]
        bare = [x.arg for x in every if x.annotation is None and x.arg not in ("self", "cls")]
        if bare:
            faults.append(f"{path}:{node.lineno} {node.name}: no annotation for {', '.join(bare)}")
    return faults


def parameters(path: str, tree: ast.Module, text: str) -> list[str]:
    """At most eight parameters; compiled kernels (njit) are let off, they cannot take dataclasses."""
    faults = []
    for node in functions(tree):
        count = len(node.args.posonlyargs + node.args.args + node.args.kwonlyargs)
        if count > MAX_PARAMETERS and not any("jit" in ast.unparse(d) for d in node.decorator_list):
            faults.append(f"{path}:{node.lineno} {node.name}: {count} parameters, allowed {MAX_PARAMETERS}")
    return faults


def docstrings(path: str, tree: ast.Module, text: str) -> list[str]:
    """Modules, public classes, public functions and their public methods say what they do."""
    faults = [] if ast.get_docstring(tree) else [f"{path}: no module docstring"]

    def visit(node: ast.Module | ast.ClassDef) -> None:
        for child in node.body:
            if not isinstance(child, Function | ast.ClassDef) or child.name.startswith("_"):
                continue
            if not ast.get_docstring(child):
                faults.append(f"{path}:{child.lineno} {child.name}: no docstring")
            if isinstance(child, ast.ClassDef):
                visit(child)

    visit(tree)
    return faults


def banned_calls(path: str, tree: ast.Module, text: str) -> list[str]:
    """Nothing that runs code from data, starts a shell or prints."""
    faults = []
    aliases = import_aliases(tree)
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom):
            modules = [node.module or ""] if isinstance(node, ast.ImportFrom) else [a.name for a in node.names]
            faults += [f"{path}:{node.lineno} imports {m}" for m in modules if m.split(".")[0] in BANNED_IMPORTS]
        if not isinstance(node, ast.Call):
            continue
        name = dotted(node.func, aliases)
        keywords = {k.arg: ast.unparse(k.value) for k in node.keywords}
        if name in BANNED_CALLS or name in BANNED_NAMES or name.startswith("torch.hub."):
            faults.append(f"{path}:{node.lineno} calls {name}")
        if keywords.get("shell", "False") != "False":
            faults.append(f"{path}:{node.lineno} runs a shell")
        if name.endswith(".load") and keywords.get("allow_pickle", "False") != "False":
            faults.append(f"{path}:{node.lineno} lets {name} unpickle")
    return [] if path in CHILD_PROCESSES else faults


def handlers(path: str, tree: ast.Module, text: str) -> list[str]:
    """No bare or blind except, and no assert: both hide or lose a fault."""
    faults = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Assert):
            faults.append(f"{path}:{node.lineno} asserts; raise instead")
        if isinstance(node, ast.ExceptHandler) and path not in PROCESS_BOUNDARIES:
            caught = ast.unparse(node.type) if node.type else "everything"
            if caught == "everything" or re.search(r"\b(Base)?Exception\b", caught):
                faults.append(f"{path}:{node.lineno} catches {caught}")
    return faults


def gradients(path: str, tree: ast.Module, text: str) -> list[str]:
    """Logarithms, roots, arcs and divisions by a norm come from safemath where gradients flow."""
    if not path.startswith(GRADIENT_PACKAGES) or path == SAFEMATH:
        return []
    faults = []
    aliases = import_aliases(tree)
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute | ast.Name):
            name = dotted(node.func, aliases)
            last = node.func.attr if isinstance(node.func, ast.Attribute) else name.rsplit(".", 1)[-1]
            modules = set(name.split(".")[:-1])
            known = isinstance(node.func, ast.Attribute) or name.startswith("torch.")
            if last in UNSAFE_GRADIENTS and known and not modules & PLAIN_MATHS:
                faults.append(f"{path}:{node.lineno} {ast.unparse(node.func)}: use scene/safemath.py")
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow) and _root(node):
            faults.append(f"{path}:{node.lineno} takes a root of a tensor: use scene/safemath.py")
        exponential = isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "exp"
        if (
            exponential
            and "scale" in ast.unparse(node)
            and not set(dotted(node.func, aliases).split(".")) & PLAIN_MATHS
        ):
            faults.append(f"{path}:{node.lineno} exponential of a scale: use scene/safemath.py")
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div) and isinstance(node.right, ast.Call):
            called = dotted(node.right.func, aliases) or ast.unparse(node.right.func)
            if called.endswith("norm") and not set(called.split(".")) & PLAIN_MATHS:
                faults.append(f"{path}:{node.lineno} divides by a norm: use scene/safemath.py")
    return faults


def _root(node: ast.BinOp) -> bool:
    """Whether a power is a fractional or negative one of the result of a method, such as `x.sum() ** 0.5`."""
    try:
        power = float(ast.literal_eval(node.right))
    except (ValueError, TypeError, SyntaxError):
        return False
    return (power < 0 or power != int(power)) and isinstance(node.left, ast.Call)


def plain_text(path: str, tree: ast.Module, text: str) -> list[str]:
    """No relative import, no catch-all module, no note left for later, no path of somebody's machine or host."""
    faults = [f"{path}: name it after what it holds"] if Path(path).stem in ("utils", "util", "helpers", "misc") else []
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level:
            faults.append(f"{path}:{node.lineno} relative import")
    faults += [f"{path}: {match.group(0)!r}" for match in PRIVATE_TEXT.finditer(text)]
    return faults


# Written in pieces, so that this file does not find itself.
PRIVATE_TEXT = re.compile(
    r"\b(?:TO" r"DO|FIX" r"ME)\b"
    r"|(?<![\w.~])/(?:work|home|Users|root|opt|mnt)/\w+"
    r"|[A-Z]:\\\\?Users"
    r"|py" r"pi\.org|download\.py" r"torch\.org|files\.python" r"hosted"
)  # fmt: skip

RULES: tuple[Rule, ...] = (
    sizes, annotations, parameters, docstrings, banned_calls, handlers, gradients, plain_text,
)  # fmt: skip
TEST_RULES: tuple[Rule, ...] = (plain_text,)

BAD: list[tuple[Rule, str]] = [
    (sizes, "x = 1\n" * 401),
    (sizes, "def f():\n" + "    x = 1\n" * 50),
    (annotations, "def f(a, *b: int) -> None: ..."),
    (annotations, "class A:\n    def f(self, *, a) -> None: ..."),
    (parameters, "def f(a: int, b: int, c: int, d: int, e: int, f: int, g: int, h: int, i: int) -> None: ..."),
    (docstrings, "x = 1"),
    (docstrings, '"""m"""\nclass A:\n    """a"""\n    def f(self) -> None: ...'),
    (banned_calls, "import pickle"),
    (banned_calls, "from torch import load as l\nl('f')"),
    (banned_calls, "import torch as t\nt.hub.load('a', 'b')"),
    (banned_calls, "import numpy as np\nnp.load('f', allow_pickle=True)"),
    (banned_calls, "import subprocess\nsubprocess.run('ls', shell=True)"),
    (banned_calls, "print('x')"),
    (banned_calls, "eval('1')"),
    (handlers, "assert True"),
    (handlers, "try:\n    pass\nexcept:\n    pass"),
    (handlers, "try:\n    pass\nexcept (ValueError, Exception):\n    pass"),
    (gradients, "import torch\ny = torch.log(x)"),
    (gradients, "y = x.norm().sqrt()"),
    (gradients, "from torch.nn import functional as F\ny = F.normalize(x)"),
    (gradients, "y = 1 / x.norm(dim=-1)"),
    (gradients, "import torch\ny = x / torch.linalg.norm(x)"),
    (gradients, "y = x.log()"),
    (gradients, "y = x.rsqrt()"),
    (gradients, "y = x.reciprocal()"),
    (gradients, "import torch\ny = torch.acos(x)"),
    (gradients, "import torch as t\ny = t.quantile(x, 0.5)"),
    (gradients, "y = (x * x).sum(-1) ** 0.5"),
    (gradients, "y = x.abs() ** -1"),
    (gradients, "import torch\ny = torch.exp(values['log_scales'])"),
    (gradients, "y = self.log_scales.exp()"),
    (plain_text, "from . import a"),
    (plain_text, "# TO" "DO later"),
    (plain_text, "p = '/ho" "me/me/clip'"),
]  # fmt: skip


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.__name__)
def test_code_keeps_the_rule(rule: Rule) -> None:
    faults = []
    for path in sources("genmojo_core", "genmojo_studio", "packaging"):
        text = path.read_text(encoding="utf-8")
        faults += rule(path.relative_to(ROOT).as_posix(), ast.parse(text), text)
    assert not faults, "\n".join(["", *faults])


@pytest.mark.parametrize("rule", TEST_RULES, ids=lambda rule: rule.__name__)
def test_tests_keep_the_rule(rule: Rule) -> None:
    faults = []
    for path in sources("tests"):
        text = path.read_text(encoding="utf-8")
        faults += rule(path.relative_to(ROOT).as_posix(), ast.parse(text), text)
    assert not faults, "\n".join(["", *faults])


@pytest.mark.parametrize(("rule", "snippet"), BAD, ids=lambda x: x.__name__ if callable(x) else "")
def test_each_rule_catches_what_it_forbids(rule: Rule, snippet: str) -> None:
    assert rule("genmojo_core/scene/sample.py", ast.parse(snippet), snippet)


def test_rules_let_plain_code_pass() -> None:
    text = '"""m"""\nimport math\nimport numpy as np\n\n\ndef f(a: float) -> float:\n    """d"""\n' \
           "    return math.log(a) / np.linalg.norm(np.sqrt([a]))\n"  # fmt: skip
    assert [fault for rule in RULES for fault in rule("genmojo_core/scene/sample.py", ast.parse(text), text)] == []


def test_no_private_path_or_host_in_other_files() -> None:
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False).stdout.split()
    texts = [ROOT / name for name in listed if name.endswith((".md", ".toml", ".txt", ".yml", ".cfg", "/run"))]
    if not texts:
        pytest.skip("not a git checkout")
    faults = [
        f"{p.name}: {m.group(0)}" for p in texts if p.exists() for m in PRIVATE_TEXT.finditer(p.read_text("utf-8"))
    ]
    assert not faults


def test_layers_and_forbidden_imports() -> None:
    """Data flows one way, the core knows no Qt, its upper half no torch (contracts in pyproject.toml)."""
    program = Path(sys.executable).with_name("lint-imports")
    if not program.exists():
        pytest.skip("import-linter is not installed (extra 'dev')")
    result = subprocess.run([str(program)], cwd=ROOT, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr


def test_command_line_starts_without_torch() -> None:
    """`genmojo inspect` and `--help` must not wait seconds for torch; each command imports what it needs itself."""
    code = "import sys, genmojo_core.cli.main; sys.exit('torch was imported' if 'torch' in sys.modules else 0)"
    result = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
