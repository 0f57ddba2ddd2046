"""ssh_test.py STRIDE UNITS FOLDER: units run behind an OpenSSH server on the loopback, which is started for it with keys
of its own, and the results are those of a run here. Exit code 77 if there is no OpenSSH server."""

import contextlib
import getpass
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

SCENARIO = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="2.0" name="filters"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="filters">
    <ssd:Elements>
      <ssd:Component name="first" source="{first}"/><ssd:Component name="second" source="minimal.fmu"/>
    </ssd:Elements>
    <ssd:Connections>
      <ssd:Connection startElement="first" startConnector="y" endElement="second" endConnector="u"/>
    </ssd:Connections>
  </ssd:System>
  <ssd:DefaultExperiment stopTime="0.05"/>
  <ssd:Annotations><ssc:Annotation type="org.stride"><stride:Scenario xmlns:stride="urn:org.stride:scenario:1">
    {hosts}
  </stride:Scenario></ssc:Annotation></ssd:Annotations>
</ssd:SystemStructureDescription>
"""


def require(condition, what):
    if not condition:
        raise AssertionError(what)


def keygen(path):
    subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", str(path)], check=True)
    return path.with_suffix(".pub").read_text()


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Server:
    """An OpenSSH server, and an `ssh` in front of the real one that knows it as `box`."""

    def __init__(self, sshd, folder, units, stride):
        self.folder = folder
        self.port = free_port()
        self.host_key = keygen(folder / "host_key")
        pinned = f'restrict,command="{stride} serve --only {units}/minimal.fmu" '
        (folder / "authorized_keys").write_text(keygen(folder / "own") + pinned + keygen(folder / "customer"))
        (folder / "sshd_config").write_text(
            f"Port {self.port}\nListenAddress 127.0.0.1\nHostKey {folder}/host_key\n"
            f"AuthorizedKeysFile {folder}/authorized_keys\nPidFile none\nStrictModes no\nUsePAM no\n"
            f"PasswordAuthentication no\nKbdInteractiveAuthentication no\nSetEnv STRIDE_UNITS={units} STRIDE_SSH_TEST={folder}\n")
        self.known = folder / "known_hosts"
        self.trust(True)
        (folder / "bin").mkdir()
        wrapper = folder / "bin" / "ssh"
        wrapper.write_text(f'#!/bin/sh\nexec {shutil.which("ssh")} -F {folder}/ssh_config "$@"\n')
        wrapper.chmod(0o755)
        self.use_key("own")
        if os.geteuid() == 0:
            os.makedirs("/run/sshd", exist_ok=True)
        with open(folder / "sshd.log", "w") as log:
            self.process = subprocess.Popen([sshd, "-D", "-e", "-f", str(folder / "sshd_config")], stderr=log)
        for _ in range(200):
            with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", self.port), 1):
                return
            time.sleep(0.05)
        raise AssertionError((folder / "sshd.log").read_text())

    def trust(self, is_known):
        self.known.write_text(f"[127.0.0.1]:{self.port} {self.host_key}" if is_known else "")

    def use_key(self, key):
        (self.folder / "ssh_config").write_text(
            f"Host box\n  HostName 127.0.0.1\n  Port {self.port}\n  User {getpass.getuser()}\n"
            f"  IdentityFile {self.folder}/{key}\n  IdentitiesOnly yes\n  UserKnownHostsFile {self.known}\n")

    def stop(self):
        self.process.terminate()
        self.process.wait()


class Runs:
    def __init__(self, stride, units, folder):
        self.stride, self.folder = stride, folder
        self.environment = {**os.environ, "STRIDE_UNITS": str(units),
                            "PATH": f"{folder}/bin:{os.environ['PATH']}", "LC_ALL": "C"}

    def start(self, name, hosts="", first="minimal.fmu", *options):
        ssd = self.folder / f"{name}.ssd"
        ssd.write_text(SCENARIO.format(hosts=hosts, first=first))
        return subprocess.Popen(
            [self.stride, "run", ssd, "--out", self.folder / name, "--quiet", "--set", "first.u=1", *options],
            env=self.environment, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)

    def run(self, name, hosts="", first="minimal.fmu"):
        process = self.start(name, hosts, first)
        errors = process.communicate(timeout=120)[1]
        return process.returncode, errors

    def signals(self, name):
        return (self.folder / name / "signals.csv").read_bytes()

    def link(self, name, unit=1):
        return json.loads((self.folder / name / "run.json").read_text())["units"][unit]["host"]["link"]


def served_processes(folder):
    """Those that the server of this test has started for stride."""
    mark = f"STRIDE_SSH_TEST={folder}".encode()
    found = []
    for entry in pathlib.Path("/proc").glob("[0-9]*/environ"):
        with contextlib.suppress(OSError):
            is_served = mark in entry.read_bytes().split(b"\0")
            if is_served and b"serve" in (entry.parent / "cmdline").read_bytes().split(b"\0"):
                found.append(int(entry.parent.name))
    return found


def require_nothing_left(folder):
    for _ in range(200):
        if not served_processes(folder):
            return
        time.sleep(0.1)
    raise AssertionError(f"processes are left: {served_processes(folder)}")


def check_runs(runs, server, stride):
    host = f'<stride:Host components="{{}}" at="ssh://box" stride="{stride}"/>'
    require(runs.run("near")[0] == 0, "the run here")
    for components in ("second", "*"):
        code, errors = runs.run("far", host.format(components))
        require(code == 0, errors)
        require(runs.signals("far") == runs.signals("near"), f"other bits of {components} over ssh")
    require(runs.link("far", 0)["round_trips"] >= 50, "round trips are counted")
    print("over ssh: the same bits")


def check_pinned_key(runs, server):
    server.use_key("customer")
    code, errors = runs.run("pinned", '<stride:Host components="first" at="ssh://box" fmu=""/>', "hidden/away.fmu")
    require(code == 0, errors)
    require(runs.signals("pinned") == runs.signals("near"), "other bits with a key that is pinned to an FMU")
    code, errors = runs.run("refused", '<stride:Host components="second" at="ssh://box" fmu="/etc/passwd"/>')
    require(code == 2 and "is not offered there" in errors, errors)
    server.use_key("own")
    print("a key that is pinned to one FMU gets this one only")


def check_faults(runs, server, stride):
    host = f'<stride:Host components="second" at="ssh://box" stride="{stride}"/>'
    server.trust(False)
    code, errors = runs.run("unknown", host)
    require(code == 1 and "Host key verification failed" in errors and "hint: the key of that" in errors, errors)
    server.trust(True)
    code, errors = runs.run("missing", '<stride:Host components="second" at="ssh://box" stride="/no/stride"/>')
    require(code == 1 and "code 127" in errors and "install stride there" in errors, errors)
    run = runs.start("lost", host, "minimal.fmu", "--stop", "100000")
    for _ in range(600):
        if (runs.folder / "lost" / "signals.csv").exists() and len(served_processes(runs.folder)) >= 2:
            break
        time.sleep(0.05)
    time.sleep(1)
    for process in served_processes(runs.folder):
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
    errors = run.communicate(timeout=60)[1]
    require(run.returncode == 1 and "unit 'second', at " in errors and "the link to box has ended" in errors, errors)
    require_nothing_left(runs.folder)
    killed = runs.start("killed", host, "minimal.fmu", "--stop", "100000")
    time.sleep(2)
    killed.kill()
    killed.communicate(timeout=60)
    require_nothing_left(runs.folder)
    print("faults are errors with a name, and nothing is left")


def main():
    stride, units, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    sshd = shutil.which("sshd", path=os.environ["PATH"] + ":/usr/sbin:/sbin")
    if not sshd or not shutil.which("ssh"):
        print("skipped: there is no OpenSSH server (openssh-server)")
        return 1 if os.environ.get("CI") == "true" else 77
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder) as scratch:
        scratch = pathlib.Path(scratch).resolve()
        server = Server(sshd, scratch, units, stride)
        try:
            runs = Runs(stride, units, scratch)
            check_runs(runs, server, stride)
            check_pinned_key(runs, server)
            check_faults(runs, server, stride)
        finally:
            server.stop()
    return 0


if __name__ == "__main__":
    sys.exit(main())
