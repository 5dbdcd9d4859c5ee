"""Tests of the eyes of the real robot, on pictures from a renderer with the noise and blur of a camera."""
