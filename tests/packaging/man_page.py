#!/usr/bin/env python3
"""man_page.py PROGRAM PAGE: the manual page names the commands of the program with their options, and no others."""
import re
import subprocess
import sys

program, page = sys.argv[1:]
help_text = subprocess.run([program, "--help-all"], check=True, capture_output=True, text=True).stdout
asked = {}
for block in re.split(r"\n(?=\w)", help_text.split("\nSubcommands:\n")[1]):
    asked[block.split("\n")[0]] = {name for names in re.findall(r"^    (-\S+)", block, re.M)
                                   for name in names.split(",")}

text = open(page, encoding="utf-8").read()
commands = text[text.index("The commands are:"):]
commands = commands[:commands.index("\n.El")]
told = {}
for block in commands.split("\n.It Cm ")[1:]:
    told[block.split()[0]] = ({"--" + name for name in re.findall(r"Fl Fl ([\w-]+)", block)}
                              | {"-" + name for name in re.findall(r"Fl (\w)\b", block)})

wrong = 0
for command in sorted(asked.keys() | told.keys()):
    if asked.get(command) != told.get(command):
        print(f"{command}: the program has {sorted(asked.get(command, ['no such command']))}, "
              f"the page {sorted(told.get(command, ['no such command']))}")
        wrong = 1
sys.exit(wrong)
