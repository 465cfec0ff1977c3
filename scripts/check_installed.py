#!/usr/bin/env python3
"""Checks that what is installed knows nothing of the folders it was built in.

    scripts/check_installed.py PREFIX FOLDER...
    scripts/check_installed.py --self-test

Prints each file below PREFIX that holds the path of one of the FOLDERs, but for PREFIX itself; exit status 1 if there is any.
"""
import pathlib
import sys
import tempfile


def files_that_name(folders, prefix):
    """The files below `prefix` that hold the path of one of `folders`, in whatever they are."""
    own = str(prefix).encode()
    for path in sorted(prefix.rglob("*")):
        if path.is_file():
            contents = path.read_bytes().replace(own, b"")
            yield from (f"{path}: holds {folder}" for folder in folders if folder.encode() in contents)


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        prefix = pathlib.Path(folder)
        (prefix / "lib").mkdir()
        (prefix / "lib" / "a").write_bytes(b"\0/usr/lib\0" + str(prefix).encode() + b"/lib/b")
        if list(files_that_name(["/home/x/build"], prefix)):
            raise SystemExit("self-test: found what is not there")
        (prefix / "lib" / "b").write_bytes(b"\0/home/x/build/src/module.so\0")
        if len(list(files_that_name(["/home/x/build"], prefix))) != 1:
            raise SystemExit("self-test: the planted path was not found")
    print("self-test: found the planted path and nothing else")


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    prefix = pathlib.Path(sys.argv[1])
    if not prefix.is_dir():
        sys.exit(f"there is no folder {prefix}")
    found = list(files_that_name(sys.argv[2:], prefix))
    print("\n".join(found) if found else "nothing names the folders it was built in")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
