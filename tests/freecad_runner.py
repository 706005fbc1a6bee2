# Executes one script inside FreeCAD and leaves its exit status in a file, which holds "started" until then. `./run` copies
# this text behind a line that sets STATUS_FILE and ARGV. It ends the process itself: FreeCAD would go on to a prompt, or run
# the script again.
import os
import runpy
import sys
import traceback


def execute():
    sys.argv = list(ARGV)
    sys.path.insert(0, os.path.dirname(ARGV[0]))
    try:
        runpy.run_path(ARGV[0], run_name="__main__")
    except SystemExit as stop:
        if stop.code is None or isinstance(stop.code, int):
            return stop.code or 0
        print(stop.code, file=sys.stderr)
        return 1
    except BaseException:
        traceback.print_exc()
        return 1
    return 0


def leave(text):
    with open(STATUS_FILE, "w") as file:
        file.write(text)


if not os.path.exists(STATUS_FILE):
    leave("started")
    code = execute() & 255
    sys.stdout.flush()
    sys.stderr.flush()
    leave(str(code))
    os._exit(code)
