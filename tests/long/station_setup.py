"""What the checks of several stations share: a chain with a hand at each mass, and the stations' certificates."""
import shutil
import subprocess


def chain_of(count, seconds):
    """An experiment of so many hands, which bears late ticks."""
    return {"schema_version": 1, "name": "chain", "constraint": {"name": "line", "shape": {"length_m": 0.2}},
            "object": {"kind": "chain", "masses_kg": [0.6] * count, "stiffness_n_per_m": [600] * (count - 1)},
            "coupling": {"stiffness_n_per_m": 600, "damping_n_s_per_m": 5}, "hands": [{"mass": i + 1} for i in range(count)],
            "timing": {"max_missed_ticks": 100000, "max_gap_s": 10},
            "task": {"start": [0], "target": [6.283185307179586], "duration_s": seconds,
                     "tolerance": {"position_m": 0.02, "velocity_m_per_s": 0.05, "time_s": 3}}}


def add_station(reach, conductor, folder, name):
    """Makes a station's folder of certificates, the conductor's where both are the same."""
    def peers(*words):
        subprocess.run([reach, "peers", *words], check=True, stdout=subprocess.DEVNULL)

    peers("init", folder, "--name", name, *(["--conductor"] if folder == conductor else []))
    if folder != conductor:
        peers("add", conductor, folder / "request.pem")
        shutil.copytree(conductor / f"for-{name}", folder, dirs_exist_ok=True)
