#!/usr/bin/env python3
"""completion.py bash|zsh PROGRAM OUT: completion for a shell, from what PROGRAM says about itself."""
import collections
import pathlib
import re
import subprocess
import sys
import tempfile

Option = collections.namedtuple("Option", "names takes_value repeats about")
Command = collections.namedtuple("Command", "name about positionals options")
Key = collections.namedtuple("Key", "path choices")

# What stands after an option, or for a positional: a `case` file, a `folder`, a `file`, a `setting` (KEY=VALUE),
# a `format`, a `material`, a `number` of a run, or free text.
kinds = {"CASE": "case", "DIR": "folder", "NAME": "material", "--set": "setting", "--vary": "setting",
         "--columns": "number", "--format": "format", "--file": "case"}
outputs = {"report": "file"}


def kind(command, name):
    return outputs.get(command, "folder") if name == "--output" else kinds.get(name, "text")


def said(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def entries(block, heading):
    """The lines below `heading` of a command's help as (names, description)."""
    section = re.search(rf"^  {heading}:\n((?:    .*\n?)*)", block, re.M)
    # A description that does not fit beside the name begins on the next line.
    text = re.sub(r"\n {30,}", "  ", section[1]) if section else ""
    return [re.split(r"  +", line.strip(), maxsplit=1) for line in text.splitlines()]


def option(left, about):
    names = left.split()[0].split(",")
    return Option(names, " " in left, "several" in about, about)


def command(block):
    name, about = (line.strip() for line in block.splitlines()[:2])
    return Command(name, about, [left.split()[0] for left, _ in entries(block, "Positionals")],
                   [option(*entry) for entry in entries(block, "Options")]
                   + [Option(["-h", "--help"], False, False, "the help of this command")])


def commands(help_text):
    listed = help_text.split("\nSubcommands:\n")[1]
    return [command(block) for block in re.split(r"\n(?=\w)", listed) if block.strip()]


def choices(row):
    named = re.search(r"one of ((?:`[^`]+`(?:, )?)+)", row)
    if named:
        return re.findall("`([^`]+)`", named[1])
    return ["true", "false"] if "| true or false |" in row else []


def keys(reference):
    """Keys of the case file by their paths; of an array of tables, those of its first entry."""
    found, table, arrays, same = [], "", set(), {}
    for line in reference.splitlines():
        heading = re.match(r"#+ (\[+)([\w.]+)\]", line)
        if heading:
            arrays |= {heading[2]} if heading[1] == "[[" else set()
            parts = heading[2].split(".")
            table = "".join(part + ("[0]." if ".".join(parts[:i + 1]) in arrays else ".")
                            for i, part in enumerate(parts))
        row = re.match(r"\| `(\w+)` \|", line)
        if row:
            found.append(Key(table + row[1], choices(line)))
        elsewhere = re.search(r"the keys are those of \[(\w+)\]", line)
        if elsewhere:
            same[table] = elsewhere[1] + "."
    return found + [Key(table + key.path.removeprefix(source), key.choices) for table, source in same.items()
                    for key in found if key.path.startswith(source)]


# What an unknown column is answered with, for a body that has all of it.
block = """mesh.box = { min = [0, 0, 0], max = [1, 1, 1], cells = [1, 1, 1], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 1 }
boundary = [{ on = "right", displacement = [0, 0, 0], potential = 0, temperature = 0 }]
contact = { on = "left", friction = { law = "tresca", bound = 1 } }
"""


def numbers(program):
    """Columns of history.csv and places of extremes, without those that name a boundary."""
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder, "block.toml")
        case.write_text(block)
        answer = subprocess.run([program, "sweep", case, "--vary", "time.steps=1", "--columns", "?", "-o", folder],
                                capture_output=True, text=True).stderr
    columns, places = re.search(r"allowed: (.*), each also as .*, and (.*)$", answer.strip()).groups()
    return [name for name in (columns + ", " + places).split(", ") if not re.match("charge_right|heat_right", name)]


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def words(all_words):
    return " ".join(quoted(word) for word in all_words)


def bash_kinds(listed):
    lines = []
    for each in listed:
        for one in each.options:
            if one.takes_value:
                lines.append(f"{'|'.join(quoted(each.name + ' ' + name) for name in one.names)}) "
                             f"kind={kind(each.name, one.names[-1])} ;;")
        if each.positionals:
            lines.append(f"{quoted(each.name + ' ')}) kind={kind(each.name, each.positionals[0])} ;;")
    return lines


def bash_options(listed):
    return [f"{each.name}) options={quoted(' '.join(name for one in each.options for name in one.names))} ;;"
            for each in listed]


def bracketed(text):
    return re.sub(r"([\[\]:])", r"\\\1", text)


def zsh_argument(name, of):
    return f"{name}:_tourmaline_{of}" if of != "text" else f"{name}: "


def zsh_option(owner, one):
    rest = f"[{bracketed(one.about)}]"
    if one.takes_value:
        rest += ":" + zsh_argument("value", kind(owner, one.names[-1]))
    return [quoted(("*" if one.repeats else "") + name + rest) for name in one.names]


def zsh_command(each):
    arguments = [text for one in each.options for text in zsh_option(each.name, one)]
    arguments += [quoted(f"*:{zsh_argument(name, kind(each.name, name))}") for name in each.positionals]
    return [f"{each.name})", "  _arguments -s \\", *(f"    {text} \\" for text in arguments[:-1]),
            f"    {arguments[-1]} ;;"]



def main(shell, program, out):
    listed = commands(said(program, "--help-all"))
    case_keys = keys(said(program, "reference"))
    materials = [line.split()[0] for line in said(program, "materials").splitlines()]
    values = [f"{quoted(key.path)}) values=({words(key.choices)}) ;;" for key in case_keys if key.choices]
    parts = {"COMMANDS": words(each.name for each in listed), "KEYS": words(key.path for key in case_keys),
             "VALUES": values, "MATERIALS": words(materials), "NUMBERS": words(numbers(program))}
    if shell == "bash":
        parts |= {"KINDS": bash_kinds(listed), "OPTIONS": bash_options(listed)}
    else:
        parts |= {"DESCRIBED": words(f"{each.name}:{each.about}" for each in listed),
                  "ARGUMENTS": [line for each in listed for line in zsh_command(each)]}
    text = pathlib.Path(__file__).with_name(f"completion.{shell}.in").read_text()
    for name, part in parts.items():
        lines = [part] if isinstance(part, str) else part
        text = re.sub(rf"^( *)(.*)@{name}@", lambda place: place[1] + place[2] + f"\n{place[1]}".join(lines), text,
                      flags=re.M)
    pathlib.Path(out).write_text(text)


main(*sys.argv[1:])
