"""What the long tests share: where the data lies, cases in child processes with a time limit, a table, the closing line.

Not a test by itself: run alone it says so and succeeds, because `./run check-long` runs every script of this folder."""
import multiprocessing
import os
import queue
import sys
import time

DATA = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "shared", "data"))


def files(folder, *endings):
    """Paths of the data files with these endings; leaves the script if the data are not there."""
    path = os.path.join(DATA, folder)
    if not os.path.isdir(path):
        print("skipped: no data beside this checkout (looked for ../shared/data/%s)" % folder)
        print("0 passed, 0 failed")
        sys.exit(0)
    chosen = sys.argv[1:]
    return [os.path.join(path, name) for name in sorted(os.listdir(path))
            if name.lower().removesuffix(".gz").endswith(endings) and (not chosen or any(c in name for c in chosen))]


def unpacked(path, folder):
    """The file itself, or its content without .gz in the given folder."""
    if not path.endswith(".gz"):
        return path
    import gzip
    target = os.path.join(folder, os.path.basename(path)[:-3])
    with gzip.open(path, "rb") as source, open(target, "wb") as out:
        out.write(source.read())
    return target


def _child(results, work, arguments):
    try:
        results.put(("value", work(*arguments)))
    except BaseException as error:  # also what is no Exception: the parent has to hear of it
        results.put(("raised", "%s: %s" % (type(error).__name__, error)))


def apart(work, arguments, seconds):
    """work(*arguments) in a process of its own: ("value", result), ("raised", sentence), ("crashed" | "timeout", sentence)."""
    context = multiprocessing.get_context("fork")
    results = context.Queue()
    child = context.Process(target=_child, args=(results, work, arguments), daemon=True)
    child.start()
    end = time.monotonic() + seconds
    while True:
        try:
            answer = results.get(timeout=0.2)
            child.join(10)
            return answer
        except queue.Empty:
            pass
        if not child.is_alive():
            try:
                return results.get(timeout=1)
            except queue.Empty:
                return "crashed", "ended with status %s" % child.exitcode
        if time.monotonic() > end:
            child.kill()
            child.join()
            return "timeout", "still running after %g s" % seconds


class Table:
    def __init__(self, *heads):
        self.passed, self.bad = 0, []
        self.row(*heads)

    def row(self, *cells):
        first, *rest = (str(c) for c in cells)
        print("%-44s %s" % (first, "  ".join("%-16s" % c for c in rest)), flush=True)

    def judge(self, name, ok, *cells):
        self.row(name, *cells, "ok" if ok else "FAILED")
        if ok:
            self.passed += 1
        else:
            self.bad.append(name)

    def end(self):
        for name in self.bad:
            print("failed: " + name)
        print("%d passed, %d failed" % (self.passed, len(self.bad)))
        sys.exit(1 if self.bad else 0)


if __name__ == "__main__":
    print("table.py is used by the other long tests; nothing to test here")
