"""Drives the workbench in a real FreeCAD window, takes pictures of it, and ends with the line 'N passed, M failed'.

    python3 tests/gui/test_gui.py            (needs xvfb-run; STARCELL_SHOTS: folder for the pictures, default build/shots)
    xvfb-run -a -s "-screen 0 1600x1000x24" freecad tests/gui/test_gui.py

Started outside, or by a FreeCAD that does not know this checkout, it starts FreeCAD under Xvfb with a home of its own. The tests
run in file order in one window, from its event loop, with real commands, keys and clicks.
"""
import os
import subprocess
import sys
import tempfile
import time
import traceback

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
MARK = "STARCELL_TEST_HOME"
SHOTS = os.environ.get("STARCELL_SHOTS") or os.path.join(ROOT, "build", "shots")
TIMEOUT_SECONDS = 420


def launch():
    with tempfile.TemporaryDirectory(prefix="starcell-home-") as home:
        os.makedirs(os.path.join(home, "Mod"))
        os.symlink(ROOT, os.path.join(home, "Mod", "StarCell"))
        environment = dict(os.environ, FREECAD_USER_HOME=home, STARCELL_SHOTS=SHOTS, **{MARK: home})
        if os.geteuid() == 0:
            environment["QTWEBENGINE_DISABLE_SANDBOX"] = "1"
        command = ["freecad", os.path.abspath(__file__)]
        if not os.environ.get("DISPLAY"):
            command = ["xvfb-run", "-a", "-s", "-screen 0 1600x1000x24"] + command
        return subprocess.call(["timeout", str(TIMEOUT_SECONDS)] + command, env=environment)


def run():
    try:
        leave(run_cases())
    except Exception:
        traceback.print_exc()
        leave(1)


def run_cases():
    sys.path.insert(0, HERE)
    import cases

    os.makedirs(SHOTS, exist_ok=True)
    passed = failed = 0
    for name, case in cases.collect():
        start = time.monotonic()
        try:
            cases.set_up()
            case(SHOTS)
            passed += 1
            print("ok      {} ({:.1f} s)".format(name, time.monotonic() - start))
        except Exception:
            failed += 1
            print("FAILED  {}\n{}".format(name, traceback.format_exc()))
        finally:
            cases.clean_up()
        sys.stdout.flush()
    print("{} passed, {} failed".format(passed, failed))
    return 1 if failed or not passed else 0


def leave(code):
    # Straight out: closing FreeCAD asks about unsaved documents, and its exit code is always 0.
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


if not getattr(sys, "starcell_gui_tests_ran", False):
    sys.starcell_gui_tests_ran = True
    if os.environ.get(MARK):
        from PySide import QtCore

        QtCore.QTimer.singleShot(1500, run)
    else:
        leave(launch())
