"""`floatref warm`: kernels compiled before the first recording."""
