"""Simulators that are processes of their own, in virtual environments of their own, and how tests start them."""
