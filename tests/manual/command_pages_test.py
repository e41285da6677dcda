#!/usr/bin/env python3
"""Man pages and completions that are made of --help: command_pages_test.py REACH"""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "packaging/manual"))
from command_line import read  # noqa: E402


class CommandPages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.made = Path(cls.folder.name)
        subprocess.run([ROOT / "packaging/manual/command_pages.py", "1.2.3", cls.made, REACH], check=True)
        cls.tree = read(REACH, ["reach"])

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def complete(self, *words):
        script = f'source {self.made}/bash/reach; COMP_WORDS=("$@"); COMP_CWORD=$(($#-1)); _reach; printf "%s\\n" "${{COMPREPLY[@]}}"'
        done = subprocess.run(["bash", "-c", script, "bash", *words], capture_output=True, text=True, check=True,
                              cwd=self.folder.name, env={**os.environ, "PATH": f"{REACH.parent}:{os.environ['PATH']}"})
        return done.stdout.split()

    def test_the_help_is_understood_whole(self):
        for command in self.tree.walk():
            text = subprocess.run([REACH, *command.words[1:], "--help"], capture_output=True, text=True, check=True).stdout
            told = {name for names in re.findall(r"^  (?:-\w,)?(--[\w-]+(?:,--[\w-]+)*)", text, re.M) for name in names.split(",")}
            self.assertEqual({name for option in command.options for name in option.names if name.startswith("--")}, told, command.name)
            for option in command.options + command.positionals:
                self.assertTrue(option.text, f"{command.name} {option.names} has no explanation")
                self.assertNotIn("  ", option.text)
        self.assertGreater(len(list(self.tree.walk())), 10)

    def test_every_command_has_a_page_with_every_option(self):
        for command in self.tree.walk():
            page = (self.made / f"man1/{command.name}.1").read_text().replace("\\-", "-")
            self.assertIn(".SH SYNOPSIS", page)
            for option in command.options:
                for name in option.names:
                    self.assertIn(f"\\fB{name}\\fR", page)

    def test_bash_completes_commands_options_and_names(self):
        self.assertEqual(self.complete("reach", "val"), ["validate"])
        self.assertEqual(self.complete("reach", "run", "--dev"), ["--device"])
        self.assertEqual(self.complete("reach", "run", "chain-s"), ["chain-slow"])
        self.assertIn("simulated", self.complete("reach", "run", "--device", ""))
        self.assertEqual(self.complete("reach", "constraint", "sh"), ["show"])
        self.assertEqual(sorted(self.complete("reach", "constraint", "show", "torus")), ["torus", "torus-knot"])
        self.assertEqual(self.complete("reach", "constraint", "eval", "torus", "--a"), ["--at"])
        self.assertEqual(self.complete("reach", "predict", "x", "--criterion", "min-t"), ["min-torque-change"])
        self.assertEqual(self.complete("reach", "export", "--format", ""), ["bids", "csv", "mat", "hdf5", "c3d"])

    def test_every_option_is_completed_in_every_shell(self):
        fish, zsh = (self.made / "fish/reach.fish").read_text(), (self.made / "zsh/_reach").read_text()
        for command in self.tree.walk():
            names = {name for option in command.options for name in option.names if name.startswith("--")}
            self.assertEqual(set(self.complete(*command.words, "--")), names, command.name)
            for name in names:
                self.assertIn(f" -l {name[2:]} ", fish)
                self.assertIn(f"{name}[", zsh)


if __name__ == "__main__":
    REACH = Path(sys.argv.pop(1)).resolve()
    unittest.main()
