"""The Franka adapter: a Panda or FR3 with cameras. Importing this loads no robot driver."""
