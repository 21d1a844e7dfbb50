#!/bin/sh
# lavapipe, Mesa's Vulkan driver for CPUs, ends the loops of an invocation after 65,535 turns of all of them together, and reports
# success. Mesa's source has this limit on purpose (LP_MAX_TGSI_LOOP_ITERATIONS), but no limit of the device tells of it.
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
import re
import sys
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

# The bounds are data, so that no compiler works the loops out. `mixed` depends on each turn, so that no loop is left out.
SHADER = """
@group(0) @binding(0) var<storage, read> bounds: array<u32, 2>;
@group(0) @binding(1) var<storage, read_write> result: array<u32, 3>;
@compute @workgroup_size(1) fn main() {
    var mixed = 1u;
    var first = 0u;
    for (var k = 0u; k < bounds[0]; k++) { mixed = mixed * 5u + 3u; first++; }
    var second = 0u;
    for (var k = 0u; k < bounds[1]; k++) { mixed = mixed * 5u + 3u; second++; }
    result = array<u32, 3>(first, second, mixed);
}
"""


def turns(*bounds):
    """Turns of the two loops on the device."""
    usage = wgpu.BufferUsage.STORAGE
    given = device.create_buffer_with_data(data=numpy.array(bounds, dtype="u4"), usage=usage)
    result = device.create_buffer(size=12, usage=usage | wgpu.BufferUsage.COPY_SRC)
    shader = device.create_shader_module(code=SHADER)
    pipeline = device.create_compute_pipeline(layout="auto", compute={"module": shader, "entry_point": "main"})
    entries = [{"binding": n, "resource": {"buffer": buffer}} for n, buffer in enumerate((given, result))]
    group = device.create_bind_group(layout=pipeline.get_bind_group_layout(0), entries=entries)
    encoder = device.create_command_encoder()
    compute = encoder.begin_compute_pass()
    compute.set_pipeline(pipeline)
    compute.set_bind_group(0, group)
    compute.dispatch_workgroups(1)
    compute.end()
    device.queue.submit([encoder.finish()])
    return tuple(numpy.frombuffer(device.queue.read_buffer(result), dtype="u4")[:2].tolist())


short, long, two = turns(30_000, 30_000), turns(200_000, 0), turns(40_000, 40_000)
print("A compute shader of one invocation has two loops, one after the other, and counts their turns.")
print("Expected: each loop has as many turns as its bound, or the device is reported as lost.")
print(f"Seen, without any error: 30,000 and 30,000 turns are asked for and made: {short}.")
print(f"200,000 turns of the first loop are asked for and {long[0]:,} are made.")
print(f"40,000 and 40,000 turns are asked for and {two[0]:,} and {two[1]:,} are made, {sum(two):,} together.")

if not driver.startswith(f"Mesa {sys.argv[1]}."):
    print(f"Not this driver: the finding is of Mesa {sys.argv[1]}.")
    sys.exit()
if (short, long, two) != ((30_000, 30_000), (65_535, 0), (40_000, 25_534)):
    sys.exit("CHANGED: this is no longer what the first lines of this script describe.")
END_OF_PYTHON
