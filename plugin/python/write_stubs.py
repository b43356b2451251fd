# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes stubs of modules. They replace `**parameters` by the parameters of a filter, each with name, type and default.
The build runs it.

    write_stubs.py FOLDER_OF_CORE FOLDER MODULE.py ...
"""
import ast
import copy
import sys
from pathlib import Path

DOTS = [ast.Expr(ast.Constant(...))]


def keywords_of(filter_):
    """The parameters of a filter as arguments of a function, and their defaults."""
    import _core  # of the folder given
    parameters = _core.parameters_of(filter_)
    return ([ast.arg(name, ast.parse(type_, mode="eval").body) for name, _, type_, *_ in parameters],
            [ast.Constant(default) for _, default, *_ in parameters])


def spell_out(function, filter_):
    arguments, defaults = keywords_of(filter_)
    function.args.kwarg = None
    function.args.kwonlyargs += arguments
    function.args.kw_defaults += defaults


def filter_named_by(function):
    """"dress" of the decorator takes_parameters_of("dress"), which is removed."""
    for decorator in function.decorator_list:
        if isinstance(decorator, ast.Call) and decorator.func.id == "takes_parameters_of":
            function.decorator_list.remove(decorator)
            return ast.literal_eval(decorator.args[0])
    return None


def filter_of_class(class_):
    """"dress" of `NAME, STEPS = "dress", (...)` in the body of the class."""
    for statement in class_.body:
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Tuple):
            names = [target.id for target in statement.targets[0].elts]
            return dict(zip(names, ast.literal_eval(statement.value)))["NAME"]
    return None


def is_public(name):
    return not name.startswith("_") or name == "__init__"


def stub_of_function(function):
    filter_ = filter_named_by(function)
    if filter_:
        spell_out(function, filter_)
    function.body = DOTS
    return function


def attributes_of(class_):
    """The attributes that __init__ annotates with a type."""
    for function in class_.body:
        if isinstance(function, ast.FunctionDef) and function.name == "__init__":
            for statement in function.body:
                if isinstance(statement, ast.AnnAssign) and is_public(statement.target.attr):
                    yield ast.AnnAssign(ast.Name(statement.target.attr), statement.annotation, None, 1)


def stub_of_filter(class_, init):
    """A filter for VTK: the constructor of its base with all parameters, and an attribute for each."""
    filter_ = filter_of_class(class_)
    spell_out(init, filter_)
    arguments, _ = keywords_of(filter_)
    attributes = [ast.AnnAssign(ast.Name(argument.arg), argument.annotation, None, 1) for argument in arguments]
    class_.body = attributes + [init]
    return class_


def stub_of_class(class_):
    body = list(attributes_of(class_))
    for statement in class_.body:
        if isinstance(statement, ast.FunctionDef) and is_public(statement.name):
            body.append(stub_of_function(statement))
        elif isinstance(statement, ast.AnnAssign) and statement.target.id.islower():
            body.append(statement)
    class_.body = body or DOTS
    return class_


def constructor_in(body):
    return next(statement for statement in body if getattr(statement, "name", "") == "__init__")


def stub_of(text):
    classes, body = {}, [ast.parse("from typing import Literal").body[0]]
    for statement in ast.parse(text).body:
        if isinstance(statement, ast.ClassDef) and filter_of_class(statement):
            shared = classes[statement.bases[0].id]
            body.append(stub_of_filter(statement, copy.deepcopy(constructor_in(shared.body))))
        elif isinstance(statement, ast.ClassDef):
            classes[statement.name] = stub_of_class(statement)
            body.append(statement)
        elif isinstance(statement, ast.FunctionDef) and is_public(statement.name):
            body.append(stub_of_function(statement))
        elif isinstance(statement, (ast.Import, ast.Assign)) \
                or getattr(statement, "module", "__future__") != "__future__":
            body.append(statement)
    return ast.unparse(ast.fix_missing_locations(ast.Module(body, []))) + "\n"


def main(core, folder, modules):
    sys.path.insert(0, core)
    for module in map(Path, modules):
        stub = stub_of(module.read_text(encoding="utf-8"))
        Path(folder, module.with_suffix(".pyi").name).write_text(stub, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
