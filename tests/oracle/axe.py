"""axe.py FOLDER: fetch axe-core, the accessibility checker, into FOLDER, and print how long its script is.

One version from the npm registry, by npm, held against the checksum below; it is kept, so that npm is asked once.  Used by
browser.py only; no part of the project.  Exit status 1 with the reason where it cannot be had.
"""
import base64
import hashlib
import pathlib
import shutil
import subprocess
import sys
import tarfile

VERSION = "4.14.1"
SHA512 = "FHfa+lmNjQZfJz1q8wKqIDwC6DExcHt/pkjNQb09a3NPjCKg2rhu5qb2S4r76ASyFNNtuFooJpZe37OgudVGtQ=="


def fetch(folder):
    """The script as text; OSError with the reason otherwise."""
    folder = pathlib.Path(folder)
    archive = folder / ("axe-core-%s.tgz" % VERSION)
    if not archive.exists():
        if not shutil.which("npm"):
            raise OSError("npm is not installed")
        folder.mkdir(parents=True, exist_ok=True)
        command = ["npm", "pack", "axe-core@" + VERSION, "--pack-destination", str(folder), "--fetch-retries=0",
                   "--fetch-timeout=20000"]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
        except subprocess.TimeoutExpired as e:
            raise OSError("npm gave no answer") from e
        if done.returncode or not archive.exists():
            lines = [s for s in done.stderr.splitlines() if "error" in s.lower()]
            raise OSError("npm: " + (lines[0] if lines else "status %d" % done.returncode))
    if base64.b64encode(hashlib.sha512(archive.read_bytes()).digest()).decode() != SHA512:
        archive.unlink()
        raise OSError("axe-core has another checksum than the one on file")
    with tarfile.open(archive) as t:
        return t.extractfile("package/axe.min.js").read().decode("utf-8")


def main():
    try:
        print(len(fetch(sys.argv[1])))
    except OSError as e:
        print(e)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
