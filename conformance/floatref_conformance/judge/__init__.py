"""The judge: cases tried on a device, the search beyond them, and the verdict with its evidence."""
