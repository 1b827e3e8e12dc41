# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the program hpvi asks of this package: `report DIR [--pdf]` and `picture SCENE.json SCENE.svg`. One line says what is wrong, and the status is 2."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))  # Python in isolation knows no path but those of Debian


def obey(words):
    try:
        import matplotlib
    except ImportError:
        raise ImportError("matplotlib is missing; install python3-matplotlib") from None
    matplotlib.use("Agg")
    if words[0] == "report":
        from hpvi import report
        report.write(words[1], pdf="--pdf" in words)
    else:
        import json
        from hpvi import plot
        text = plot.scene_svg(json.loads(pathlib.Path(words[1]).read_text(encoding="utf-8")))
        pathlib.Path(words[2]).write_text(text, encoding="utf-8")


def main():
    try:
        obey(sys.argv[1:])
    except (ImportError, ValueError) as error:  # RunError is a ValueError, and it has a remedy
        print(error)
    except OSError as error:
        print(f"{error.filename or 'a file'}: {error.strerror}")
    except Exception as error:  # whatever else: one line, for a user reads no stack
        print(f"{type(error).__name__}: {error}")
    else:
        return 0
    return 2


sys.exit(main())
