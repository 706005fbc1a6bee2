"""Prints 'passed failed' from a GoogleTest JSON report: count_gtest.py REPORT."""
import json
import sys

with open(sys.argv[1]) as file:
    report = json.load(file)
failed = report["failures"] + report.get("errors", 0)
ran = sum(case.get("status") == "RUN" and case.get("result") != "SKIPPED"
          for suite in report["testsuites"] for case in suite["testsuite"])
print(ran - failed, failed)
