# SPDX-License-Identifier: Apache-2.0
"""A Slurm of its own on this machine: munged, slurmctld and one slurmd for each node, on free ports of 127.0.0.1.

    with SlurmCluster(folder, nodes=2, cpus=1) as slurm:
        slurm.run("sbatch", "--wrap", "hostname")
        slurm.kill_node("node1")
        slurm.start_node("node1")
"""
import os
import pwd
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "server"))
from free_ports import free_ports

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "sinfo", "scancel")
# Where Debian keeps daemons, which PATH of users may leave out.
PATH = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
# States in which Slurm still works for a job.
UNFINISHED = ("PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "REQUEUED", "SUSPENDED", "STOPPED")

CONFIGURATION = """\
ClusterName=tetralight
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={controller_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire={requeue_seconds}
MpiDefault=none
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,bf_interval=1,bf_min_age_reserve=0,batch_sched_delay=0,sched_min_interval=0
ReturnToService=2
SlurmdParameters=config_overrides
SlurmctldTimeout=10
SlurmdTimeout=300
KillWait=20
MinJobAge=300
MailProg=/bin/true
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmdPidFile={folder}/%n.pid
SlurmdLogFile={folder}/%n.log
SlurmctldPidFile={folder}/slurmctld.pid
SlurmctldLogFile={folder}/slurmctld.log
{nodes}
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""
NODE = "NodeName={name} NodeHostname=localhost NodeAddr=127.0.0.1 Port={port} CPUs={cpus} State=UNKNOWN\n"


def missing():
    """Why no Slurm can run here; empty if one can."""
    absent = [name for name in PROGRAMS if shutil.which(name, path=PATH) is None]
    if absent:
        return "there is no " + ", ".join(absent) + " (Debian packages slurmctld, slurmd, slurm-client and munge)"
    return "" if os.geteuid() == 0 else "Slurm's nodes need root"


def wait_until(is_true, seconds, what):
    end = time.monotonic() + seconds
    while not is_true():
        if time.monotonic() > end:
            raise TimeoutError("waited too long: " + what)
        time.sleep(0.1)


def processes():
    """Identifiers of all processes of this machine."""
    return [int(entry) for entry in os.listdir("/proc") if entry.isdigit()]


def name_of(process):
    """How `ps` calls a process; empty if it has ended."""
    try:
        return Path("/proc", str(process), "cmdline").read_bytes().split(b"\0")[0].decode(errors="replace")
    except OSError:
        return ""


def session_of(process):
    try:
        return os.getsid(process)
    except OSError:  # it has ended meanwhile
        return None


def has_open(process, path):
    try:
        files = [os.readlink(f"/proc/{process}/fd/{number}") for number in os.listdir(f"/proc/{process}/fd")]
    except OSError:
        return False
    return str(path) in files


def send(process, number):
    """A signal, if the process has not ended."""
    try:
        os.kill(process, number)
    except ProcessLookupError:
        pass


class SlurmCluster:
    """All files lie in `folder`, whose path has no blanks and is short: sockets lie there too."""

    def __init__(self, folder, nodes=2, cpus=1, requeue_seconds=5):
        self.folder = Path(folder)
        self.names = [f"node{i + 1}" for i in range(nodes)]
        self.daemons = {}
        self.sessions = set()  # of jobs on nodes that were killed
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"), PATH=PATH)
        for name in [name for name in self.environment if name.startswith(("SBATCH_", "SQUEUE_", "SINFO_"))]:
            del self.environment[name]
        ports = free_ports(nodes + 1)
        lines = [NODE.format(name=name, port=port, cpus=cpus) for name, port in zip(self.names, ports[1:])]
        self.folder.mkdir(parents=True, exist_ok=True)
        for name in ["state"] + self.names:
            (self.folder / name).mkdir(exist_ok=True)
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            folder=self.folder, user=pwd.getpwuid(os.geteuid()).pw_name, controller_port=ports[0],
            nodes="".join(lines), requeue_seconds=requeue_seconds))

    def __enter__(self):
        try:
            self.start()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_):
        self.stop()

    def start(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        self.daemon("munged", "--foreground", "--force", f"--socket={self.folder}/munge.socket", f"--key-file={key}",
                    f"--pid-file={self.folder}/munged.pid", f"--seed-file={self.folder}/munged.seed")
        wait_until((self.folder / "munge.socket").exists, 30, "munged")
        self.daemon("slurmctld", "-D", "-c")
        for name in self.names:
            self.start_node(name)
        wait_until(self.is_ready, 60, "nodes of Slurm: " + self.log())

    def daemon(self, program, *arguments, name=None):
        log = open(self.folder / f"{name or program}.out", "ab")
        self.daemons[name or program] = subprocess.Popen([program, *arguments], env=self.environment, stdout=log,
                                                         stderr=log, stdin=subprocess.DEVNULL)
        log.close()

    def start_node(self, name):
        self.daemon("slurmd", "-D", "-N", name, name=name)

    def steps(self, name):
        """Processes of slurmstepd on a node: each runs one job, in a session of its own."""
        return [process for process in processes()
                if name_of(process).startswith("slurmstepd") and has_open(process, self.folder / f"{name}.log")]

    def kill_node(self, name):
        """Kills the daemons of a node, and has Slurm know at once, not after SlurmdTimeout: its jobs are requeued. What
        they started goes on until `stop`, as nothing knows it any more."""
        steps = self.steps(name)
        self.sessions.update(map(session_of, steps))
        for process in steps:
            send(process, signal.SIGKILL)
        daemon = self.daemons.pop(name)
        daemon.kill()
        daemon.wait()
        self.run("scontrol", "update", f"NodeName={name}", "State=DOWN", "Reason=killed", check=False, timeout=20)

    def is_ready(self):
        found = self.run("sinfo", "--noheader", "--Node", "--format=%N %t", check=False).stdout.split()
        return found.count("idle") == len(self.names)

    def run(self, *command, check=True, **options):
        """Runs a program as a user of this Slurm."""
        done = subprocess.run([str(word) for word in command], env=self.environment, capture_output=True, text=True,
                              **options)
        if check and done.returncode != 0:
            raise RuntimeError(f"{command[0]} ended with {done.returncode}: {done.stdout}{done.stderr}")
        return done

    def state(self, job):
        """Of a job, as Slurm writes it: RUNNING, COMPLETED, FAILED... All elements of an array have to agree."""
        found = self.run("scontrol", "--oneliner", "show", "job", job).stdout
        states = {word.partition("=")[2] for word in found.split() if word.startswith("JobState=")}
        return states.pop() if len(states) == 1 else "RUNNING" if states & set(UNFINISHED) else "FAILED"

    def wait_for(self, job, seconds):
        """The state of a job at its end."""
        wait_until(lambda: self.state(job) not in UNFINISHED, seconds, f"job {job}")
        return self.state(job)

    def log(self):
        """The last lines of all daemons, for messages of failed tests."""
        lines = []
        for path in sorted([*self.folder.glob("*.log"), *self.folder.glob("*.out")]):
            lines += [f"{path.name}: {line}" for line in path.read_text(errors="replace").splitlines()[-20:]]
        return "\n".join(lines)

    def stop(self):
        """Ends all daemons and all that jobs started."""
        for name in self.names:
            self.sessions.update(map(session_of, self.steps(name)))
        for process in processes():
            if session_of(process) in self.sessions - {None}:
                send(process, signal.SIGKILL)
        for daemon in self.daemons.values():
            daemon.kill()
            daemon.wait()
        self.daemons.clear()
