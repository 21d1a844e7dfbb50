"""Position Based Fluids (Macklin and Müller 2013) in Taichi, at rest in a box: a peer for `vitriol bench --against`.

    pip install -r study/peers/requirements.txt
    vitriol bench --against study/peers/taichi_pbf.py

What is compared is the same: count, spacing, h/d = 2, substeps, iterations, the cubic spline, walls as shares of the kernel,
viscosity by XSPH. As fast as we could write it with what Taichi has: particles sorted by cell, rows of cells walked at once, a
neighbour list with a margin that is built anew only when somebody has moved, multiplier and position fetched together, all of a
substep in one kernel. The artificial pressure and the vorticity of the publication are left out, being of no use at rest.
"""

import ctypes
import math
import os

# Standard output is for the result.
os.environ.setdefault("ENABLE_TAICHI_HEADER_PRINT", "0")

import taichi as ti

import peer

# Most neighbours that a particle may have: some 51 with the margin.
CAPACITY = 96
# A prediction further than this share of the margin from where the list was built asks for another.
WAY = 0.4


def options():
    parser = peer.arguments(__doc__.splitlines()[0])
    parser.add_argument("--margin", type=float, default=0.15, help="of the neighbour list, support radii; 0: one in every substep")
    parser.add_argument("--relaxation", type=float, default=0.5, help="share of each multiplier that is applied")
    parser.add_argument("--block", type=int, default=128, help="threads in a block on a GPU")
    return parser.parse_args()


def started(arch):
    """Starts Taichi where it was asked for; the device's name."""
    wanted = {"gpu": [ti.cuda, ti.vulkan], "cuda": ti.cuda, "vulkan": ti.vulkan, "cpu": ti.cpu}
    if arch not in wanted:
        raise SystemExit(f"there is no --arch {arch}: give one of {', '.join(wanted)}")
    ti.init(arch=wanted[arch], default_fp=ti.f32, log_level=ti.ERROR)
    got = ti.lang.impl.current_cfg().arch
    # It falls back to the processor and says so in the log alone.
    if arch != "cpu" and got not in (ti.cuda, ti.vulkan):
        raise SystemExit(f"Taichi finds no device for --arch {arch}; give --arch cpu, or install the driver's library")
    if got == ti.cuda:
        return f"{cuda_name()}, CUDA", got
    return (f"{peer.processor()}", got) if got != ti.vulkan else ("Vulkan's first device", got)


def cuda_name():
    name = ctypes.create_string_buffer(128)
    try:
        ctypes.CDLL("libcuda.so.1").cuDeviceGetName(name, 128, 0)
    except OSError:
        return "the first device"
    return name.value.decode()


@ti.func
def three(v):
    return ti.Vector([v[0], v[1], v[2]])


@ti.func
def four(v, last):
    return ti.Vector([v[0], v[1], v[2], last])


@ti.data_oriented
class Liquid:
    def __init__(self, args, on_processor):
        positions, (width, depth) = peer.lattice(args)
        self.n, self.d = args.particles, args.spacing
        # Particle volume times the kernel's value at 0.
        self.weight = 1.0 / math.pi
        self.h, self.iterations, self.block = 2.0 * self.d, args.iterations, args.block
        self.dt = args.frame_time / args.substeps
        self.gravity, self.viscosity, self.relaxation = args.gravity, args.viscosity, args.relaxation
        self.size = (width, depth)
        self.reach = (1.0 + args.margin) * self.h
        self.way = WAY * args.margin * self.h
        # The liquid may rise by a third before it leaves the grid, and then is listed with what is at its top.
        self.depth = float(positions[:, 1].max()) + 0.5 * self.d
        top = float(positions[:, 1].max()) * 1.33 + self.h
        self.cells = [int(extent / self.reach) + 1 for extent in (width, top, depth)]
        # On a processor one thread's neighbours lie side by side, on a GPU those of neighbouring threads.
        self.by_particle = on_processor
        # Vectors of four, as a GPU likes to fetch them; the fourth of `solved` is the multiplier, m².
        vectors = [ti.Vector.field(4, ti.f32, self.n) for _ in range(9)]
        self.place, self.velocity, self.smoothed, self.trial, self.solved = vectors[:5]
        self.origin, self.sorted_place, self.sorted_smoothed, self.sorted_trial = vectors[5:]
        self.counts = ti.field(ti.i32, self.n)
        self.list = ti.field(ti.i32, (self.n, CAPACITY) if on_processor else (CAPACITY, self.n))
        # Each particle's number in its cell; each cell's first particle, and where its row ends.
        self.rank = ti.field(ti.i32, self.n)
        self.starts = ti.field(ti.i32, (self.cells[1] * self.cells[2], self.cells[0] + 1))
        self.used = ti.field(ti.i32, ())
        self.stale = ti.field(ti.i32, ())
        self.rebuilds = ti.field(ti.i32, ())
        self.overflows = ti.field(ti.i32, ())
        self.ratio = ti.field(ti.f32, self.n)
        self.fill(positions)

    def fill(self, positions):
        import numpy as np

        whole = np.zeros((self.n, 4), np.float32)
        whole[:, :3] = positions
        self.place.from_numpy(whole)
        self.stale[None] = 1
        self.predict()

    def state(self):
        """Root mean square of speeds, m/s, and where the uppermost particle is, m."""
        import numpy as np

        speeds = self.smoothed.to_numpy()[:, :3].astype(np.float64)
        return float(np.sqrt((speeds**2).sum(-1).mean())), float(self.place.to_numpy()[:, 1].max())

    @ti.func
    def spline(self, q):
        """The kernel over its value at 0, q = r/h."""
        a = ti.max(1.0 - q, 0.0)
        b = ti.max(0.5 - q, 0.0)
        return 2.0 * a * a * a - 8.0 * b * b * b

    @ti.func
    def slope(self, q):
        a = ti.max(1.0 - q, 0.0)
        b = ti.max(0.5 - q, 0.0)
        return -6.0 * a * a + 24.0 * b * b

    @ti.func
    def beyond(self, s):
        """Share of the kernel beyond a plane at the distance s, and by how much it falls with s, 1/m."""
        q = ti.max(s / self.h, 0.0)
        a = ti.max(1.0 - q, 0.0)
        share = a**5 * (1.6 - 16.0 / 15.0 * a)
        falls = a**4 * (8.0 - 6.4 * a)
        if q < 0.5:
            q2 = q * q
            share = 0.5 - q * (1.4 + q2 * (-8.0 / 3.0 + q2 * (4.8 - 3.2 * q)))
            falls = 1.4 + q2 * (-8.0 + q2 * (24.0 - 19.2 * q))
        return ti.Vector([share, falls / self.h])

    @ti.func
    def walls(self, x):
        """Share of the kernel within floor and walls, and its gradient. In an edge what two have in common counts once."""
        low = self.beyond(x[0]), self.beyond(x[1]), self.beyond(x[2])
        high = self.beyond(self.size[0] - x[0]), self.beyond(self.size[1] - x[2])
        free = ti.Vector([1.0 - low[0][0] - high[0][0], 1.0 - low[1][0], 1.0 - low[2][0] - high[1][0]])
        steep = ti.Vector([high[0][1] - low[0][1], -low[1][1], high[1][1] - low[2][1]])
        gradient = ti.Vector([steep[0] * free[1] * free[2], steep[1] * free[0] * free[2], steep[2] * free[0] * free[1]])
        return ti.Vector([gradient[0], gradient[1], gradient[2], 1.0 - free[0] * free[1] * free[2]])

    @ti.func
    def inside(self, x):
        x[0] = ti.min(ti.max(x[0], 0.0), self.size[0])
        x[1] = ti.max(x[1], 0.0)
        x[2] = ti.min(ti.max(x[2], 0.0), self.size[1])
        return x

    @ti.func
    def neighbour(self, i, k):
        j = 0
        if ti.static(self.by_particle):
            j = self.list[i, k]
        else:
            j = self.list[k, i]
        return j

    @ti.func
    def cell(self, x):
        """Along x, y and z."""
        at = ti.Vector([int(x[0] / self.reach), int(x[1] / self.reach), int(x[2] / self.reach)])
        for k in ti.static(range(3)):
            at[k] = ti.min(ti.max(at[k], 0), self.cells[k] - 1)
        return at

    @ti.func
    def go(self, i, v):
        """Velocity under gravity, and where it leads to; asks for a list where that is too far from where the last one was built."""
        v[1] -= self.dt * self.gravity
        x = self.inside(three(self.place[i]) + self.dt * v)
        self.trial[i] = four(x, 0.0)
        if (x - three(self.origin[i])).norm_sqr() >= self.way * self.way:
            self.stale[None] = 1

    @ti.func
    def multiply(self, i):
        """The multiplier of a particle: what its own constraint asks for, never a pull."""
        x = three(self.trial[i])
        density, own, squares = 1.0, ti.Vector([0.0, 0.0, 0.0]), 0.0
        for k in range(self.counts[i]):
            away = x - three(self.trial[self.neighbour(i, k)])
            distance = ti.max(away.norm(), 1e-6 * self.h)
            gradient = away * (self.slope(distance / self.h) / distance)
            density += self.spline(distance / self.h)
            own += gradient
            squares += gradient.norm_sqr()
        scale = self.weight / self.h
        wall = self.walls(x)
        own = scale * own + three(wall)
        constraint = ti.max(density * self.weight + wall[3] - 1.0, 0.0)
        # A lone particle's sum is next to nothing; a full neighbourhood's is about 1.5/d².
        sum = own.norm_sqr() + scale * scale * squares + 0.01 / (self.d * self.d)
        self.solved[i] = four(x, -self.relaxation * constraint / sum)

    @ti.func
    def displaced(self, i):
        """Where the multipliers move a particle. A wall mirrors: it answers with the particle's own, and along it the pressure's
        gradient is made up for the neighbours that are not there. Without that, what is at a wall sinks for ever."""
        own = self.solved[i]
        x = three(own)
        sum = ti.Vector([0.0, 0.0, 0.0])
        for k in range(self.counts[i]):
            other = self.solved[self.neighbour(i, k)]
            away = x - three(other)
            distance = ti.max(away.norm(), 1e-6 * self.h)
            sum += away * ((own[3] + other[3]) * self.slope(distance / self.h) / distance)
        wall = self.walls(x)
        by = sum * (self.weight / self.h) + 2.0 * own[3] * three(wall)
        if wall[3] > 0.0:
            normal = three(wall).normalized(1e-12)
            along = by - normal * by.dot(normal)
            by += along * (1.0 / ti.max(1.0 - wall[3], 0.3) - 1.0)
        return self.inside(x + by)

    @ti.func
    def smooth(self, i):
        """XSPH, walls at rest, and where the next substep begins."""
        x, v = three(self.place[i]), three(self.velocity[i])
        sum = ti.Vector([0.0, 0.0, 0.0])
        for k in range(self.counts[i]):
            j = self.neighbour(i, k)
            distance = (x - three(self.place[j])).norm()
            sum += (three(self.velocity[j]) - v) * self.spline(distance / self.h)
        v += self.viscosity * (self.weight * sum - self.walls(x)[3] * v)
        self.smoothed[i] = four(v, 0.0)
        self.go(i, v)

    @ti.func
    def search(self, i):
        """Lists those within reach of a particle, which takes its sorted place."""
        x = three(self.sorted_trial[i])
        found, at = 0, self.cell(x)
        first, last = ti.max(at[0] - 1, 0), ti.min(at[0] + 1, self.cells[0] - 1) + 1
        for z in range(ti.max(at[2] - 1, 0), ti.min(at[2] + 1, self.cells[2] - 1) + 1):
            for y in range(ti.max(at[1] - 1, 0), ti.min(at[1] + 1, self.cells[1] - 1) + 1):
                row = y + z * self.cells[1]
                for j in range(self.starts[row, first], self.starts[row, last]):
                    near = (x - three(self.sorted_trial[j])).norm_sqr() < self.reach * self.reach
                    if near and j != i:
                        if found < CAPACITY:
                            if ti.static(self.by_particle):
                                self.list[i, found] = j
                            else:
                                self.list[found, i] = j
                        found += 1
        if found > CAPACITY:
            self.overflows[None] += 1
        self.counts[i] = ti.min(found, CAPACITY)
        self.place[i] = self.sorted_place[i]
        self.smoothed[i] = self.sorted_smoothed[i]
        self.trial[i], self.origin[i] = self.sorted_trial[i], self.sorted_trial[i]

    @ti.kernel
    def predict(self):
        for i in range(self.n):
            self.go(i, three(self.smoothed[i]))

    @ti.kernel
    def substep(self):
        # The list, if somebody asked for it: no loop does anything if not.
        for row, cell in self.starts:
            if self.stale[None] == 1:
                self.starts[row, cell] = 0
                self.used[None] = 0
        ti.loop_config(block_dim=self.block)
        for i in range(self.n):
            if self.stale[None] == 1:
                at = self.cell(three(self.trial[i]))
                self.rank[i] = ti.atomic_add(self.starts[at[1] + at[2] * self.cells[1], at[0]], 1)
        # Each row of cells, whose particles follow each other, takes the next free places: rows may come in any order.
        for row in range(self.cells[1] * self.cells[2]):
            if self.stale[None] == 1:
                count = 0
                for cell in range(self.cells[0]):
                    count += self.starts[row, cell]
                start = ti.atomic_add(self.used[None], count)
                for cell in range(self.cells[0] + 1):
                    here = self.starts[row, cell]
                    self.starts[row, cell] = start
                    start += here
        ti.loop_config(block_dim=self.block)
        for i in range(self.n):
            if self.stale[None] == 1:
                at = self.cell(three(self.trial[i]))
                to = self.starts[at[1] + at[2] * self.cells[1], at[0]] + self.rank[i]
                self.sorted_place[to] = self.place[i]
                self.sorted_smoothed[to] = self.smoothed[i]
                self.sorted_trial[to] = self.trial[i]
        ti.loop_config(block_dim=self.block)
        for i in range(self.n):
            if self.stale[None] == 1:
                self.search(i)
        for iteration in ti.static(range(self.iterations)):
            ti.loop_config(block_dim=self.block)
            for i in range(self.n):
                self.multiply(i)
                if i == 0 and ti.static(iteration == 0):
                    self.rebuilds[None] += self.stale[None]
                    self.stale[None] = 0
            ti.loop_config(block_dim=self.block)
            for i in range(self.n):
                x = self.displaced(i)
                if ti.static(iteration + 1 == self.iterations):
                    self.velocity[i] = four((x - three(self.place[i])) / self.dt, 0.0)
                    self.place[i] = four(x, 0.0)
                else:
                    self.trial[i] = four(x, 0.0)
        ti.loop_config(block_dim=self.block)
        for i in range(self.n):
            self.smooth(i)

    @ti.kernel
    def measure(self):
        """Density over the rest density, at the end of a substep."""
        for i in range(self.n):
            x = three(self.place[i])
            sum = 1.0
            for k in range(self.counts[i]):
                sum += self.spline((x - three(self.place[self.neighbour(i, k)])).norm() / self.h)
            self.ratio[i] = sum * self.weight + self.walls(x)[3]


def main():
    args = options()
    device, arch = started(args.arch)
    liquid = Liquid(args, arch not in (ti.cuda, ti.vulkan))

    def frame():
        for _ in range(args.substeps):
            liquid.substep()

    for _ in range(math.ceil(peer.WARM_UP / args.frame_time)):
        frame()
    ti.sync()
    built = liquid.rebuilds[None]
    times = peer.timed(args, frame, ti.sync)
    built = liquid.rebuilds[None] - built
    liquid.measure()
    if liquid.overflows[None]:
        raise SystemExit(f"{liquid.overflows[None]} times more than {CAPACITY} neighbours: take more substeps or iterations")
    frames = len(times) * peer.QUEUED
    speed, top = liquid.state()
    more = {"lists_per_frame": built / frames, "rms_speed_m_s": speed, "top_m": top, "depth_m": liquid.depth}
    peer.report(args, "Taichi PBF", ".".join(map(str, ti.__version__)), device, times, liquid.ratio.to_numpy(), **more)


if __name__ == "__main__":
    main()
