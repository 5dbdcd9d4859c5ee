"""Benchmarks: `python -m tests.benchmarks NAME --json`. Each module here has one function `run() -> Result`."""
