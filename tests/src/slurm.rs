//! A cluster of one node: Slurm, as Debian has it (`slurm-wlm`), without root. `./lab setup` unpacks it.

use std::fs::Permissions;
use std::net::TcpListener;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use crate::{installed, wait};

/// Path of Slurm's installation.
#[derive(Debug)]
pub struct Slurm {
    root: PathBuf,
}

/// A running cluster, which ends when this is dropped, with all its jobs.
#[derive(Debug)]
pub struct Cluster {
    slurm: Slurm,
    folder: PathBuf,
    /// The processes of Munge, the controller and the node, in the order of their start.
    daemons: Vec<Child>,
}

impl Slurm {
    /// Slurm on this machine; `None` if it is missing, with a message on standard error. With `CI=true` that is a failure instead.
    ///
    /// # Panics
    /// Where there is none and `CI=true`.
    #[must_use]
    pub fn find(test: &str) -> Option<Self> {
        let root = installed::find(
            "slurm-1",
            "Slurm, which spreads jobs over machines, is",
            test,
        )?;
        Some(Self { root })
    }

    /// Folder of libraries, and among them Slurm's plugins: its name contains the machine's.
    fn libraries(&self) -> PathBuf {
        let folders = std::fs::read_dir(self.root.join("usr/lib")).unwrap();
        let mut folders = folders.map(|it| it.unwrap().path());
        let with_plugins = folders.find(|it| it.join("slurm-wlm").is_dir());
        with_plugins.expect("Slurm's plugins are there")
    }

    fn command(&self, program: &str) -> Command {
        let mut command = Command::new(self.root.join("usr").join(program));
        let libraries = self.libraries();
        let paths = [libraries.join("slurm-wlm"), libraries];
        command.env("LD_LIBRARY_PATH", std::env::join_paths(paths).unwrap());
        command
    }

    /// Starts a cluster that keeps its files in this folder, and waits until its node accepts jobs: `at_a_time` at a time.
    ///
    /// # Panics
    /// Where it does not start.
    #[must_use]
    pub fn start(self, folder: &Path, at_a_time: u32) -> Cluster {
        let mut cluster = Cluster {
            slurm: self,
            folder: folder.to_owned(),
            daemons: Vec::new(),
        };
        for name in ["state", "spool"] {
            std::fs::create_dir(folder.join(name)).unwrap();
        }
        let own = |name: &str| folder.join(name).display().to_string();
        let key: Vec<u8> = (0..=127).collect();
        std::fs::write(folder.join("munge.key"), key).unwrap();
        let own_alone = Permissions::from_mode(0o600);
        std::fs::set_permissions(folder.join("munge.key"), own_alone).unwrap();
        std::fs::write(folder.join("slurm.conf"), cluster.configuration(at_a_time)).unwrap();
        // `--force`: a temporary folder is writable by others, above.
        let options = [
            "--foreground".to_owned(),
            "--force".to_owned(),
            format!("--key-file={}", own("munge.key")),
            format!("--socket={}", own("munge")),
            format!("--pid-file={}", own("munge.pid")),
            format!("--seed-file={}", own("munge.seed")),
        ];
        cluster.daemon("sbin/munged", &options);
        wait::until("Munge listens", || {
            folder.join("munge").exists().then_some(())
        });
        cluster.daemon("sbin/slurmctld-wlm", &["-D".into(), "-i".into()]);
        let of_tasks = cluster.slurm.root.join("usr/sbin/slurmstepd-wlm");
        let of_tasks = of_tasks.display().to_string();
        cluster.daemon("sbin/slurmd-wlm", &["-D".into(), "-d".into(), of_tasks]);
        wait::until("the node takes jobs", || {
            cluster.still_run();
            let told = cluster.ask("sinfo", &["--noheader", "--format=%T"]);
            (String::from_utf8_lossy(&told.stdout).trim() == "idle").then_some(())
        });
        cluster
    }
}

impl Cluster {
    /// Slurm's configuration, without features that need root, control groups or another node.
    fn configuration(&self, at_a_time: u32) -> String {
        let id = |option| {
            let told = Command::new("id").arg(option).output().unwrap();
            String::from_utf8(told.stdout).unwrap().trim().to_owned()
        };
        let host = Command::new("uname").arg("-n").output().unwrap();
        let host = String::from_utf8(host.stdout).unwrap();
        // As Slurm uses it: without the domain.
        let host = host.trim().split('.').next().unwrap().to_owned();
        let [controller, node] = free_ports();
        let (user, folder) = (id("-un"), self.folder.display());
        let plugins = self.slurm.libraries().join("slurm-wlm");
        format!(
            "ClusterName=class
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={folder}/munge
CredType=cred/munge
SlurmUser={user}
SlurmdUser={user}
PluginDir={plugins}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=0
ReturnToService=2
SlurmdParameters=config_overrides
NodeName={host} NodeAddr=127.0.0.1 CPUs={at_a_time} State=UNKNOWN
PartitionName=class Nodes={host} Default=YES MaxTime=INFINITE State=UP
",
            plugins = plugins.display()
        )
    }

    fn daemon(&mut self, program: &str, options: &[String]) {
        let mut command = self.slurm.command(program);
        let log = self.folder.join(program.replace('/', "-"));
        let log = std::fs::File::create(log).unwrap();
        let child = command
            .args(options)
            .env("SLURM_CONF", self.folder.join("slurm.conf"))
            .stdin(Stdio::null())
            .stdout(log.try_clone().unwrap())
            .stderr(log)
            .spawn();
        self.daemons.push(child.unwrap());
    }

    fn still_run(&mut self) {
        for daemon in &mut self.daemons {
            if let Some(end) = daemon.try_wait().unwrap() {
                let mut said = String::new();
                for file in ["sbin-munged", "sbin-slurmctld-wlm", "sbin-slurmd-wlm"] {
                    said += &std::fs::read_to_string(self.folder.join(file)).unwrap_or_default();
                }
                panic!("the cluster ended: {end}: {said}");
            }
        }
    }

    /// Output of one of Slurm's programs, such as `squeue`.
    ///
    /// # Panics
    /// Where it cannot be started.
    #[must_use]
    pub fn ask(&self, program: &str, arguments: &[&str]) -> Output {
        let mut command = self.slurm.command(&format!("bin/{program}"));
        let conf = self.folder.join("slurm.conf");
        command.args(arguments).env("SLURM_CONF", conf);
        command.output().unwrap()
    }

    /// Submits a script with `sbatch` in this folder; returns the job's number. Libraries are the machine's own in it again.
    ///
    /// # Panics
    /// Where Slurm refuses it.
    #[must_use]
    pub fn submit(&self, folder: &Path, script: &Path, options: &[&str]) -> String {
        let chdir = format!("--chdir={}", folder.display());
        let script = script.display().to_string();
        let own = ["--parsable", "--export=ALL,LD_LIBRARY_PATH=", &chdir];
        let arguments = [&own[..], options, &[&script]].concat();
        let told = self.ask("sbatch", &arguments);
        let errors = String::from_utf8_lossy(&told.stderr);
        assert!(told.status.success(), "{arguments:?}: {errors}");
        String::from_utf8(told.stdout).unwrap().trim().to_owned()
    }

    /// Waits until a job has ended; returns the state of each of its tasks by number, as `COMPLETED` or `FAILED`.
    ///
    /// # Panics
    /// Where that takes too long.
    #[must_use]
    pub fn ends(&self, job: &str) -> Vec<(u32, String)> {
        wait::until("the job ends", || {
            let states = self.states(job);
            let over =
                |state: &str| !["PENDING", "RUNNING", "COMPLETING", "CONFIGURING"].contains(&state);
            let all = !states.is_empty() && states.iter().all(|(_, state)| over(state));
            all.then_some(states)
        })
    }

    /// The state of each of a job's tasks, as `squeue` prints it.
    ///
    /// # Panics
    /// Where it prints no number.
    #[must_use]
    pub fn states(&self, job: &str) -> Vec<(u32, String)> {
        let job = format!("--jobs={job}");
        let options = [
            "--noheader",
            "--states=all",
            "--array",
            "--format=%K %T",
            &job,
        ];
        let told = self.ask("squeue", &options);
        let told = String::from_utf8(told.stdout).unwrap();
        let mut states: Vec<_> = told
            .lines()
            .filter_map(|line| line.trim().split_once(' '))
            .map(|(task, state)| (task.parse().unwrap(), state.trim().to_owned()))
            .collect();
        states.sort();
        states
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        let user = Command::new("id").arg("-un").output();
        if let Ok(user) = user {
            let user = String::from_utf8_lossy(&user.stdout).trim().to_owned();
            let _ = self.ask("scancel", &["--signal=KILL", "--user", &user]);
            let _ = self.ask("scancel", &["--user", &user]);
        }
        for daemon in self.daemons.iter_mut().rev() {
            // It fails if the process has ended by itself, which is fine.
            let _ = daemon.kill();
            let _ = daemon.wait();
        }
    }
}

/// Two ports of this machine that nobody listens on.
fn free_ports() -> [u16; 2] {
    // Both are held at once, so that they differ.
    let held = [(); 2].map(|()| TcpListener::bind(("127.0.0.1", 0)).unwrap());
    held.map(|it| it.local_addr().unwrap().port())
}
