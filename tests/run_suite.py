"""Runs the unittest files of one folder: run_suite.py FOLDER RESULT_FILE.

Works the same in plain Python, in freecadcmd and in FreeCAD's window. The result file gets 'passed failed' and is
written only when the suite came to its end, so that a crash cannot pass for success. Skipped tests count as neither.
"""
import os
import sys
import unittest

folder, result_file = sys.argv[1:3]
sys.path.insert(0, folder)
suite = unittest.TestLoader().discover(folder, pattern="test_*.py", top_level_dir=folder)
# FreeCAD's own sys.stderr has no buffer to flush in order with C++ output: the real descriptor does.
with os.fdopen(os.dup(2), "w") as stream:
    result = unittest.TextTestRunner(stream=stream, verbosity=1).run(suite)
failed = len(result.failures) + len(result.errors) + len(result.unexpectedSuccesses)
# A fixture that fails is an error without a test run; it must not make the count of passed tests negative.
passed = max(0, result.testsRun - failed - len(result.skipped) - len(result.expectedFailures))
with open(result_file, "w") as file:
    file.write("%d %d\n" % (passed + len(result.expectedFailures), failed))
sys.exit(1 if failed or not result.testsRun else 0)
