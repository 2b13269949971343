"""Devices in containers: started by podman or docker, without a network, and removed."""
