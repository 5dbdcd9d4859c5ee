"""Tests of `robot_adapters`."""
