"""What the adapters of several formats use."""
