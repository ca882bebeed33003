"""terminal.py [NAME=VALUE...] -- COMMAND...: run a command with a terminal for its standard output and error.

NAME= without a value takes the variable away; COLUMNS=N is how wide the terminal is.  What the terminal received goes to standard output, with "\n" for the terminal's
"\r\n"; the exit status is the command's.
"""
import fcntl
import os
import pty
import struct
import sys
import termios


def main():
    i = sys.argv.index("--")
    env = dict(os.environ)
    for setting in sys.argv[1:i]:
        name, value = setting.split("=", 1)
        env.pop(name, None)
        if value:
            env[name] = value
    pid, fd = pty.fork()
    if pid == 0:
        if "COLUMNS" in env:
            fcntl.ioctl(1, termios.TIOCSWINSZ, struct.pack("4H", 50, int(env["COLUMNS"]), 0, 0))
        os.execvpe(sys.argv[i + 1], sys.argv[i + 1:], env)
    out = b""
    while True:
        try:
            part = os.read(fd, 65536)
        except OSError:  # the other end is closed
            part = b""
        if not part:
            break
        out += part
    sys.stdout.buffer.write(out.replace(b"\r\n", b"\n"))
    return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])


if __name__ == "__main__":
    sys.exit(main())
