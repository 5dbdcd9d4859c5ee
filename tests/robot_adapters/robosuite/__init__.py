"""Tests of the robosuite adapter, in physics and with real pictures."""
