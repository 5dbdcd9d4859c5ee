"""Tests of the tasks' rules."""
