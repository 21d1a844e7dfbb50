#!/bin/sh
# On lavapipe, Mesa's Vulkan driver for CPUs, a branch that no invocation takes costs nearly as much as one that all take: an `if` only masks
# lanes, and no code is jumped over, not even where the condition is the same for all. So a shader that returns early saves nothing.
# This was seen with Mesa 22.3.6 (Debian 12). Other versions print what they do, and are not judged.
set -eu
SEEN=22.3

there=$(mktemp -d)
trap 'rm -rf "$there"' EXIT
trap 'exit 2' INT TERM
python3 -m venv "$there/venv" || exit 2
"$there/venv/bin/pip" install -q --disable-pip-version-check wgpu==0.32.0 numpy==2.4.6 || exit 2

export XDG_RUNTIME_DIR="${XDG_RUNTIME_DIR:-$there}"
"$there/venv/bin/python" - "$SEEN" <<'END_OF_PYTHON'
import sys
import time
from importlib.metadata import version

import numpy
import wgpu

adapters = [adapter for adapter in wgpu.gpu.enumerate_adapters_sync()
            if adapter.info["device"].startswith("llvmpipe") and adapter.info["backend_type"] == "Vulkan"]
print(f"wgpu-py {version('wgpu')}, wgpu-native {'.'.join(map(str, wgpu.backends.wgpu_native.lib_version_info))}")
if not adapters:
    print("Not this driver: this machine has no llvmpipe for Vulkan.")
    sys.exit()
driver = adapters[0].info["description"]
print(f"{adapters[0].info['device']}, {driver}")
device = adapters[0].request_device_sync()

INVOCATIONS = 1 << 19
# Each value depends on the one before, so that none is left out.
WORK = "v = v * 5u + 3u; v = v ^ (v >> 7u);\n" * 400
SHADER = """
@group(0) @binding(0) var<storage, read> wanted: array<u32, 1>;
@group(0) @binding(1) var<storage, read_write> result: array<u32>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    var v = id.x;
    BODY
    result[id.x] = v;
}
"""
BODIES = {
    "none of it": "",
    "behind an `if` that is false": "if (wanted[0] != 0u) { WORK }",
    "after a return": "if (wanted[0] == 0u) { return; } WORK",
    "behind an `if` that is true": "if (wanted[0] == 0u) { WORK }",
}


def kernel(body):
    """A function that runs a shader once and waits for it."""
    usage = wgpu.BufferUsage.STORAGE
    given = device.create_buffer_with_data(data=numpy.zeros(1, dtype="u4"), usage=usage)
    result = device.create_buffer(size=4 * INVOCATIONS, usage=usage | wgpu.BufferUsage.COPY_SRC)
    shader = device.create_shader_module(code=SHADER.replace("BODY", body).replace("WORK", WORK))
    pipeline = device.create_compute_pipeline(layout="auto", compute={"module": shader, "entry_point": "main"})
    # A shader whose branch is gone binds one buffer less.
    used = [(0, given), (1, result)] if body else [(1, result)]
    entries = [{"binding": n, "resource": {"buffer": buffer}} for n, buffer in used]
    group = device.create_bind_group(layout=pipeline.get_bind_group_layout(0), entries=entries)

    def run():
        encoder = device.create_command_encoder()
        compute = encoder.begin_compute_pass()
        compute.set_pipeline(pipeline)
        compute.set_bind_group(0, group)
        compute.dispatch_workgroups(INVOCATIONS // 64)
        compute.end()
        begin = time.perf_counter()
        device.queue.submit([encoder.finish()])
        device.queue.read_buffer(result, 0, 4)
        return time.perf_counter() - begin

    return run


kernels = {name: kernel(body) for name, body in BODIES.items()}
times = {name: [] for name in kernels}
# In turn, so that other work of the machine slows all alike. The first round compiles.
for turn in range(8):
    for name, run in kernels.items():
        took = run()
        if turn > 0:
            times[name].append(took)
least = {name: min(took) for name, took in times.items()}
whole = least["behind an `if` that is true"]
print(f"{INVOCATIONS:,} invocations have 800 operations in an `if` whose condition is one word of a buffer.")
print("Expected: if the word makes it false for all, they take little more than without the operations.")
print("Seen, as a share of the time where it is true for all:")
for name, took in least.items():
    print(f"  {took / whole:.2f}  the operations stand {name}" if name != "none of it" else f"  {took / whole:.2f}  there are no operations")

if not driver.startswith(f"Mesa {sys.argv[1]}."):
    print(f"Not this driver: the finding is of Mesa {sys.argv[1]}.")
    sys.exit()
untaken = min(least["behind an `if` that is false"], least["after a return"])
if least["none of it"] > 0.3 * whole or untaken < 0.7 * whole:
    sys.exit("CHANGED: this is no longer what the first lines of this script describe.")
END_OF_PYTHON
