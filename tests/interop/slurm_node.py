"""A Slurm cluster of one node, this machine, for tests: the daemons of Debian's packages run as the user who starts them,
with ports on the loopback that are free and all files in one folder, and end with the object."""

import ctypes
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel", "scontrol", "sinfo")
SEARCHED = os.pathsep.join([os.environ.get("PATH", ""), "/usr/sbin", "/sbin"])
CONFIGURATION = """ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0
SlurmdParameters=config_overrides
ReturnToService=2
MinJobAge=4
KillWait=5
PropagateResourceLimits=NONE
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors} State=UNKNOWN
PartitionName=test Nodes=ALL Default=YES MaxTime=60 State=UP
{further}
"""


def missing_programs():
    return [program for program in PROGRAMS if not shutil.which(program, path=SEARCHED)]


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


def end_with_parent():
    """In a new process: also if the test is killed, no daemon stays."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)  # PR_SET_PDEATHSIG


class SlurmNode:
    """To be used in a `with` statement. `environment` is what programs of Slurm need to find it."""

    def __init__(self, folder, further="", processors=4):
        self.folder = pathlib.Path(folder).resolve()
        self.environment = {**os.environ, "PATH": SEARCHED, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self._daemons = []
        self._further = further
        self._processors = processors

    def __enter__(self):
        try:
            self._make_files()
            self._start("munged", "--foreground", *(f"--{name}-file={self.folder}/munge/{name}"
                                                    for name in ("key", "log", "pid", "seed")),
                        f"--socket={self.folder}/munge/socket")
            self._await(lambda: (self.folder / "munge/socket").exists(), "munged has no socket")
            self._start("slurmctld", "-D")
            self._start("slurmd", "-D")
            self._await(lambda: self.ask("sinfo", "--noheader", "--format=%T").strip() == "idle", "the node is not idle")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        """Ends the jobs, too: a daemon that is ended leaves them running."""
        if len(self._daemons) == 3:
            subprocess.run(["scancel", "--quiet", "--user", self._user()], env=self.environment, check=False, timeout=10)
            self._wait_for(lambda: not self.ask("squeue", "--noheader").strip(), 10)
        for daemon in reversed(self._daemons):
            daemon.terminate()
            try:
                daemon.wait(timeout=10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        self._daemons = []

    def ask(self, *command):
        """What a program of Slurm prints; nothing if it fails."""
        return subprocess.run(command, env=self.environment, text=True, check=False, stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, timeout=20).stdout

    def wait_for(self, condition, what, seconds=30):
        if not self._wait_for(condition, seconds):
            raise AssertionError(f"{what} after {seconds} s\n{self.logs()}")

    def logs(self):
        files = sorted(self.folder.glob("*.log"))
        return "\n".join(f"--- {file.name}\n" + "\n".join(file.read_text(errors="replace").splitlines()[-15:])
                         for file in files)

    @staticmethod
    def _user():
        return subprocess.run(["id", "-un"], text=True, check=True, stdout=subprocess.PIPE).stdout.strip()

    def _make_files(self):
        for name in ("state", "spool", "munge"):
            (self.folder / name).mkdir(parents=True)
        for folder in (self.folder, self.folder / "munge"):  # munged wants a socket that all can reach
            folder.chmod(0o711)
        key = self.folder / "munge/key"
        key.touch(mode=0o600)
        key.write_bytes(os.urandom(128))
        controller_port, node_port = free_ports(2)
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=socket.gethostname().split(".")[0], user=self._user(), folder=self.folder, controller_port=controller_port,
            node_port=node_port, processors=self._processors, further=self._further), encoding="utf-8")

    def _start(self, program, *arguments):
        log = self.folder / f"{program}.out.log"
        with open(log, "wb") as output:
            self._daemons.append(subprocess.Popen([shutil.which(program, path=SEARCHED), *arguments], env=self.environment,
                                                  stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                                                  preexec_fn=end_with_parent))

    def _wait_for(self, condition, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if condition():
                return True
            time.sleep(0.1)
        return False

    def _await(self, condition, what):
        def is_so():
            for daemon in self._daemons:
                if daemon.poll() is not None:
                    raise AssertionError(f"{daemon.args[0]} has ended with {daemon.returncode}\n{self.logs()}")
            return condition()
        self.wait_for(is_so, what)
