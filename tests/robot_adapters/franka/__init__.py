"""Tests of the Franka adapter, against simulators that speak its protocol."""
