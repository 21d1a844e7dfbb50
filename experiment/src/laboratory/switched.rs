//! What a track's switches do to a laboratory, before the step that they come with.

use vitriol_sim::world::World;
use vitriol_xr::Switch;

use super::{Laboratory, blame_world, camera};
use crate::audible::Audible;
use crate::failure::{Blame, Failure};
use crate::instruction::Instruction;
use crate::looks::Looks;
use crate::switches::{
    self, GLASS, SWITCH_GLASS, SWITCH_PLACEMENT, SWITCH_SCENE, SWITCH_SOLVER, SWITCH_START,
};
use crate::wish::Wish;
use vitriol_sim::measure::Departures;

impl Laboratory {
    /// Does what the switches say, in their order; whether that brought up a scene.
    pub(super) fn switch(&mut self, switches: &[Switch]) -> Result<bool, Failure> {
        let mut anew = false;
        for switch in switches {
            match switch.key.as_str() {
                SWITCH_SCENE | SWITCH_START => {
                    self.bring_up(&switch.value)?;
                    anew = true;
                }
                SWITCH_SOLVER => self.change_solver(&switch.value)?,
                SWITCH_PLACEMENT => self.world.hands_leap(),
                SWITCH_GLASS => self.change_glass(&switch.value)?,
                _ => {
                    self.grant(switch)?;
                    self.follow(switch)?;
                }
            }
        }
        Ok(anew)
    }

    /// Solves from the next step on as a session's governor did.
    fn change_solver(&mut self, value: &str) -> Result<(), Failure> {
        let effort = switches::pair(value);
        let effort = effort.map_err(|error| format!("a switch to the solver {value:?}: {error}"));
        let effort = effort.input()?;
        self.solver_changes += u64::from(effort != self.world.effort());
        self.world.set_effort(effort).input()?;
        Ok(())
    }

    fn change_glass(&mut self, value: &str) -> Result<(), Failure> {
        let Some(breaks) = GLASS.iter().position(|name| *name == value) else {
            return Err(format!(
                "a switch of the glass to {value:?}: it holds or breaks"
            ))
            .input();
        };
        self.breakable = breaks == 1;
        self.world.set_breakable(self.breakable);
        Ok(())
    }

    /// Tells the lesson that is judged what its student asked for, where the switch is of that.
    fn grant(&mut self, switch: &Switch) -> Result<(), Failure> {
        let Some(wish) = Wish::of(switch) else {
            return Ok(());
        };
        // Where nothing is judged, a wish that only another version knows does no harm.
        if let Some(judging) = &mut self.judging {
            judging.ask(self.time.seconds(), wish.input()?);
        }
        Ok(())
    }

    /// Does what an instructor did, where the switch is of one.
    fn follow(&mut self, switch: &Switch) -> Result<(), Failure> {
        let Some(instruction) = Instruction::of(switch) else {
            return Ok(());
        };
        let instruction = instruction.input()?;
        match &instruction {
            // A replay in another scene.
            Instruction::Intensity(value) if self.world.intensity().is_none() => {
                tracing::warn!("a switch of k_v to {value} is left out: this scene has none");
            }
            Instruction::Intensity(value) => {
                let set = self.world.set_intensity(*value);
                set.map_err(|error| format!("a switch of k_v to {value}: {error}"))
                    .input()?;
            }
            Instruction::Spare(on) => {
                self.muted = *on;
                self.audible.mute_boiling(*on);
            }
            // Between two steps, where nothing is simulated.
            Instruction::Pause(_) | Instruction::Speed(_) | Instruction::Message(_) => {}
        }
        let said = (self.time.seconds(), instruction);
        self.instructions.push(said);
        Ok(())
    }

    fn bring_up(&mut self, name: &str) -> Result<(), Failure> {
        let scene = self.scenes.get(name)?.with_preset(self.preset);
        let gpu = self.world.gpu().clone();
        self.world = World::new(&gpu, &self.shaders, &scene, self.seed).map_err(blame_world)?;
        self.world.set_breakable(self.breakable);
        self.film = camera(&self.world, &self.shaders, self.shot, &self.colours)?;
        (self.departures, self.start) = (Departures::default(), None);
        self.end_attempt()?;
        if let Some(judging) = &mut self.judging {
            judging.bring_up();
        }
        self.audible = Audible::of(&scene);
        self.audible.mute_boiling(self.muted);
        self.looks = Looks::of(name, &scene);
        self.switched = Some(name.to_owned());
        Ok(())
    }
}
