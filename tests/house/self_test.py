"""The scripts of this folder test themselves before they judge: each finds what it looks for, and nothing else."""


def judges_wrongly(script, finds, said, silent):
    """Prints the texts that are judged wrongly; whether there are any. `finds`: what the script finds in a text."""
    wrong = [text for text in said if not finds(text)] + [text for text in silent if finds(text)]
    for text in wrong:
        print(f"{script} judges wrongly: {text!r}")
    return bool(wrong)
