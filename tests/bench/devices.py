"""Finds out what pt says about devices."""

import json
import subprocess


def runs_on_cpu(pt, device):
    """Whether a device, as a report of pt's names it, is a CPU, so that CPU seconds say what work on it costs."""
    listed = subprocess.run([pt, "devices", "--json"], check=True, capture_output=True, text=True)
    return any(one["kind"] == "CPU" for one in json.loads(listed.stdout) if one["uuid"] == device["uuid"])
