"""Runs tests/freecad/test_*.py inside freecadcmd and ends with the line 'N passed, M failed'.

    python3 tests/freecad/run_tests.py [part of a test's name]        or        freecadcmd tests/freecad/run_tests.py

Started outside, or by a FreeCAD that does not know this checkout, it starts freecadcmd with a home of its own in which the
checkout is an installed workbench: FreeCAD restores documents only through the classes of installed ones. The exit code is
explicit, because freecadcmd returns 0 whatever happens, and the guard at the end is there because it may run a script twice.
"""
import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
MARK = "STARCELL_TEST_HOME"
FILTER = "STARCELL_TEST_FILTER"


def launch():
    with tempfile.TemporaryDirectory(prefix="starcell-home-") as home:
        os.makedirs(os.path.join(home, "Mod"))
        os.symlink(ROOT, os.path.join(home, "Mod", "StarCell"))
        environment = dict(os.environ, FREECAD_USER_HOME=home, **{MARK: home})
        arguments = [each for each in sys.argv[1:] if each != os.path.abspath(__file__) and not each.endswith("run_tests.py")]
        environment[FILTER] = arguments[0] if arguments else environment.get(FILTER, "")
        return subprocess.call(["freecadcmd", os.path.abspath(__file__)], env=environment)


def run():
    sys.path.insert(0, HERE)
    suite = unittest.TestSuite()
    for test in _flat(unittest.defaultTestLoader.discover(HERE, pattern="test_*.py")):
        if os.environ.get(FILTER, "") in test.id():
            suite.addTest(test)
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(suite)
    failed = len(result.failures) + len(result.errors) + len(result.unexpectedSuccesses)
    passed = result.testsRun - failed - len(result.skipped)
    for test, reason in result.skipped:
        print("skipped: {}: {}".format(test.id(), reason))
    print("{} passed, {} failed".format(passed, failed))
    return 1 if failed or not passed else 0


def _flat(suite):
    for test in suite:
        if isinstance(test, unittest.TestSuite):
            yield from _flat(test)
        else:
            yield test


def main():
    code = run() if os.environ.get(MARK) else launch()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


if not getattr(sys, "starcell_tests_ran", False):
    sys.starcell_tests_ran = True
    main()
