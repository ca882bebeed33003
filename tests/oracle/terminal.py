"""terminal.py [NAME=VALUE...] -- COMMAND...: run a command with a terminal for its standard streams.

NAME= without a value takes the variable away; COLUMNS=N is how wide the terminal is.  What the terminal received goes to
standard output, with "\n" for the terminal's "\r\n"; the exit status is the command's.

The terminal is kept open until all of it has been read: what is still in a terminal when its last writer closes it can be lost.
"""
import fcntl
import os
import pty
import struct
import subprocess
import sys
import termios
import threading

END = b"\0end of the command\0"


def main():
    i = sys.argv.index("--")
    env = dict(os.environ)
    for setting in sys.argv[1:i]:
        name, value = setting.split("=", 1)
        env.pop(name, None)
        if value:
            env[name] = value
    screen, line = pty.openpty()
    if "COLUMNS" in env:
        fcntl.ioctl(line, termios.TIOCSWINSZ, struct.pack("4H", 50, int(env["COLUMNS"]), 0, 0))
    command = subprocess.Popen(sys.argv[i + 1:], stdin=line, stdout=line, stderr=line, env=env, start_new_session=True)

    def mark_the_end():
        command.wait()
        os.write(line, END)

    threading.Thread(target=mark_the_end).start()
    out = b""
    while not out.endswith(END):
        out += os.read(screen, 65536)
    sys.stdout.buffer.write(out[:-len(END)].replace(b"\r\n", b"\n"))
    return command.returncode


if __name__ == "__main__":
    sys.exit(main())
