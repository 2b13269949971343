"""`floatref straightedge`: what a straightedge and a profilograph measure on a road."""
