#!/usr/bin/env python3
"""Every message that the tests of the command line cause: messages.py TEST_CLI [--show]

Runs test_cli with REACHLAB_MESSAGES, which makes each test write the messages of its wrong commands into a file. Prints how many there are, and
with --show each message once, without its numbers and folders. The tests themselves check the form (expectTheOneForm in program.h)."""
import os
import re
import subprocess
import sys
import tempfile


def main():
    with tempfile.TemporaryDirectory() as folder:
        list_file = os.path.join(folder, "messages")
        done = subprocess.run([sys.argv[1], "--gtest_brief=1"], env=os.environ | {"REACHLAB_MESSAGES": list_file}, capture_output=True, text=True, check=False)
        text = open(list_file, encoding="utf-8", errors="replace").read()
    commands = text.split("$ reach ")[1:]
    messages = {}
    for command in commands:
        words, _, said = command.partition("\n")
        for message in re.split(r"(?m)^(?=(?:.+?(?::\d+){0,2}: )?error: )", said):
            if message.strip():
                messages.setdefault(re.sub(r"/tmp/[\w/.-]*/|\d+", "#", message), (words, message))
    if "--show" in sys.argv:
        for words, message in messages.values():
            print(f"$ reach {words}\n{message}")
    print(f"{len(commands)} wrong commands, {len(messages)} different messages, test_cli ends with {done.returncode}")
    if done.returncode != 0:
        print(done.stdout[-4000:])
    return done.returncode or not messages


if __name__ == "__main__":
    sys.exit(main())
