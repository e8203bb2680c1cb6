"""The types that _core.pyi states are those of the compiled module: names, arguments, defaults, properties."""

import ast
import inspect
import pathlib
import unittest

import fpz
from fpz import _core

STUB = pathlib.Path(fpz.__file__).with_name("_core.pyi")
PARTS = {"_run_tests", "_calibrate", "_run_scene", "_read_frame"}  # of the programs, which a build may not have


def described(function):
    """Names and defaults of a compiled function's arguments, from the signature that opens its docstring."""
    line = function.__doc__.strip().splitlines()[0]
    tree = ast.parse(f"def {line.replace('**kwargs', '**kwargs: object')}: ...").body[0]
    return arguments(tree)


def arguments(tree):
    def listed(names, defaults):
        missing = [None] * (len(names) - len(defaults))
        return [(n.arg, None if d is None else ast.dump(d)) for n, d in zip(names, missing + list(defaults))]

    a = tree.args
    return listed(a.args, a.defaults), listed(a.kwonlyargs, a.kw_defaults), a.kwarg and a.kwarg.arg


class Stub(unittest.TestCase):
    def setUp(self):
        self.tree = ast.parse(STUB.read_text(encoding="utf-8"))

    def test_the_same_names(self):
        stated = {n.name for n in self.tree.body if isinstance(n, (ast.ClassDef, ast.FunctionDef))}
        real = {n for n in vars(_core) if not n.startswith("__")}
        self.assertEqual(stated - PARTS, real - PARTS)
        self.assertLessEqual(real & PARTS, stated)

    def test_functions(self):
        count = 0
        for node in self.tree.body:
            if isinstance(node, ast.FunctionDef) and hasattr(_core, node.name):
                self.assertEqual(arguments(node), described(getattr(_core, node.name)), node.name)
                count += 1
        self.assertGreaterEqual(count, 4)

    def test_classes(self):
        for node in self.tree.body:
            if not isinstance(node, ast.ClassDef):
                continue
            real = getattr(_core, node.name)
            members = {n for n in vars(real) if not n.startswith("_")}
            self.assertEqual({n.name for n in node.body if not n.name.startswith("_")}, members, node.name)
            for member in node.body:
                found = getattr(real, member.name)
                kinds = [ast.unparse(d) for d in member.decorator_list]
                if not kinds:
                    self.assertEqual(arguments(member), described(found), f"{node.name}.{member.name}")
                    continue
                self.assertIsInstance(found, property)
                setter = any(n.name == member.name and n is not member for n in node.body)
                self.assertEqual(found.fset is not None, setter, f"{node.name}.{member.name}")

    def test_everything_public_is_explained(self):
        for name in fpz.__all__:
            thing = getattr(fpz, name)
            if name == "__version__":
                continue
            self.assertTrue(inspect.getdoc(thing), name)
            if inspect.isclass(thing) and thing.__module__ == "fpz._core":
                for member, value in vars(thing).items():
                    if not member.startswith("_"):
                        self.assertTrue(value.__doc__, f"{name}.{member}")

    def test_all_is_complete(self):
        public = {n for n, v in vars(fpz).items() if not n.startswith("_") and not inspect.ismodule(v)}
        self.assertEqual(public | {"__version__", "plot"}, set(fpz.__all__))

    def test_python_files_are_typed(self):
        for name in ("_runs", "_json", "_errors", "plot"):
            tree = ast.parse(STUB.with_name(name + ".py").read_text(encoding="utf-8"))
            for node in ast.walk(tree):
                if isinstance(node, ast.FunctionDef):
                    self.assertIsNotNone(node.returns, f"{name}.{node.name}")


if __name__ == "__main__":
    unittest.main()
